#pragma once
// Words and numbers of the text formats of surfaces, as other programs write them.

#include <cstdint>
#include <string_view>

#include "io/input_file.hpp"

namespace tinsmith {

/// Takes the next word off the front of `rest`; empty when there is none.
std::string_view take_word(std::string_view& rest);

/// The word as a number, with or without a plus. Complains through the file when it is none.
double number_of(const InputFile& file, std::string_view word);

/// As number_of, for whole numbers.
std::int64_t whole_number_of(const InputFile& file, std::string_view word);

}  // namespace tinsmith
