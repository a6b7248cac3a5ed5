#include "text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string_view>
#include <system_error>

#include "tinsmith/error.hpp"

namespace tinsmith::cli {

void set_manual(CLI::App& app, std::string manual) {
  app.formatter_fn(
      [manual = std::move(manual)](const CLI::App*, const std::string&, CLI::AppFormatMode) { return manual; });
  app.set_help_flag("--help,-h");
}

std::string in_one_line(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

std::string grouped(std::uint64_t number) {
  std::string digits = std::to_string(number);
  for (std::size_t i = digits.size(); i > 3; i -= 3) digits.insert(i - 3, 1, ' ');
  return digits;
}

std::string metres(double value) { return fmt::format("{:.5g} m", value); }

std::string duration(double seconds) {
  if (seconds < 60) return fmt::format("{:.{}f} s", seconds, seconds < 10 ? 2 : 1);
  const auto whole = static_cast<std::int64_t>(std::llround(seconds));
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
}

std::string byte_size(std::uint64_t bytes) {
  constexpr std::array kUnits{"bytes", "kB", "MB", "GB", "TB"};
  auto size = static_cast<double>(bytes);
  std::size_t unit = 0;
  for (; size >= 999.5 && unit + 1 < kUnits.size(); ++unit) size /= 1000;
  return fmt::format("{:.{}f} {}", size, unit > 0 && size < 9.95 ? 1 : 0, kUnits[unit]);
}

std::uint64_t to_bytes(const std::string& flag, const std::string& size) {
  constexpr std::string_view kUnits = "KMGT";
  constexpr double kMost = 1e18;
  std::size_t n_digits = 0;
  double number = 0;
  const auto [end, error] = std::from_chars(size.data(), size.data() + size.size(), number);
  if (error == std::errc()) n_digits = static_cast<std::size_t>(end - size.data());
  std::string unit = size.substr(n_digits);
  for (char& c : unit) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  const std::size_t power = unit.empty() ? 0 : kUnits.find(unit[0]) + 1;  // 0: not there
  if (power > 0) unit.erase(0, 1);
  const bool is_unit = unit.empty() || unit == "B" || (unit == "IB" && power > 0);
  const double bytes = std::ldexp(number, 10 * static_cast<int>(power));
  if (n_digits == 0 || !is_unit || !(bytes >= 1 && bytes <= kMost))
    throw UsageError(fmt::format("{} '{}': give a size like 512M, 1G or 2GiB", flag, size));
  return static_cast<std::uint64_t>(bytes);
}

void require_written_results() {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return;
  throw OutputError(
      fmt::format("standard output: the results can't be written: {}; send them elsewhere", std::strerror(errno)));
}

}  // namespace tinsmith::cli
