#pragma once
// Words and numbers for people.

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>

namespace tinsmith::cli {

/// --help prints this text, and nothing that CLI11 makes up.
void set_manual(CLI::App& app, std::string manual);

/// Line ends as spaces, and none at the end.
std::string in_one_line(std::string text);

/// 1234567 as "1 234 567".
std::string grouped(std::uint64_t number);

/// Five significant digits, no exponent for everyday sizes.
std::string metres(double value);

/// "0.42 s", "3 min 20 s".
std::string duration(double seconds);

/// "123 MB" (millions of bytes).
std::string byte_size(std::uint64_t bytes);

/// Bytes of a size like 512M, 1.5G or 2GiB: k, M, G and T are powers of 1024, with or without B or iB; without one,
/// bytes. Throws UsageError that names the flag, also for 0.
std::uint64_t to_bytes(const std::string& flag, const std::string& size);

/// Throws OutputError when standard output did not take all that was printed.
void require_written_results();

}  // namespace tinsmith::cli
