#pragma once
// Bytes at places in files. Failures name the file and the system's reason.

#include <cstdint>
#include <string>
#include <string_view>

namespace tinsmith {

/// Appends to a file, which is made when it is not there; returns where the bytes begin. All of them or, where the
/// disk is full, none: throws OutputError.
std::uint64_t append_to_file(const std::string& path, std::string_view bytes);

/// As many of the `size` bytes from `offset` as the file has; empty when there is no such file or it can't be read.
std::string read_from_file(const std::string& path, std::uint64_t offset, std::uint64_t size);

/// Whether an open file still bears this name, a link not followed.
bool is_named(int descriptor, const std::string& name);

/// In bytes; 0 when there is no such file.
std::uint64_t file_size_or_zero(const std::string& path);

}  // namespace tinsmith
