#include "io/surface_text.hpp"

#include <algorithm>
#include <charconv>
#include <string>
#include <system_error>

namespace tinsmith {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

// So much of a word is quoted in a complaint.
constexpr std::size_t kQuoted = 20;

std::string quoted(std::string_view word) {
  std::string text(word.substr(0, kQuoted));
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return text;
}

template <class T>
T parsed(const InputFile& file, std::string_view word) {
  std::string_view digits = word;
  if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-') digits.remove_prefix(1);
  T value{};
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || end != digits.data() + digits.size())
    file.fail("'" + quoted(word) + "' stands where a number belongs");
  return value;
}

}  // namespace

std::string_view take_word(std::string_view& rest) {
  std::size_t begin = 0;
  while (begin < rest.size() && is_blank(rest[begin])) ++begin;
  std::size_t end = begin;
  while (end < rest.size() && !is_blank(rest[end])) ++end;
  const std::string_view word = rest.substr(begin, end - begin);
  rest.remove_prefix(end);
  return word;
}

double number_of(const InputFile& file, std::string_view word) { return parsed<double>(file, word); }

std::int64_t whole_number_of(const InputFile& file, std::string_view word) {
  return parsed<std::int64_t>(file, word);
}

}  // namespace tinsmith
