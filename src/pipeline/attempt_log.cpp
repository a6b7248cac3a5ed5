#include "pipeline/attempt_log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <sstream>

#include "base/disk.hpp"
#include "base/hash.hpp"

namespace tinsmith {

namespace {

// Bits of the tolerance, two counts, and the checksum of these.
std::string line_of(const Attempt& attempt) {
  const std::string words = fmt::format("{:a} {} {}", attempt.tolerance, attempt.triangles, attempt.full_triangles);
  return fmt::format("{} {:016x}\n", words, hash_of(words));
}

std::optional<Attempt> attempt_of(const std::string& line) {
  Attempt attempt;
  if (std::sscanf(line.c_str(), "%la %" SCNu64 " %" SCNu64, &attempt.tolerance, &attempt.triangles,
                  &attempt.full_triangles) != 3)
    return std::nullopt;
  return line_of(attempt) == line + "\n" ? std::optional(attempt) : std::nullopt;
}

}  // namespace

AttemptLog::AttemptLog(std::string file) : file_(std::move(file)) {
  std::istringstream lines(read_from_file(file_, 0, file_size_or_zero(file_)));
  for (std::string line; std::getline(lines, line);)
    if (const auto attempt = attempt_of(line)) attempts_.push_back(*attempt);
}

std::optional<Attempt> AttemptLog::find(double tolerance) const {
  const auto found = std::find_if(attempts_.begin(), attempts_.end(),
                                  [tolerance](const Attempt& attempt) { return attempt.tolerance == tolerance; });
  return found == attempts_.end() ? std::nullopt : std::optional(*found);
}

// A line break first: what stands before may be torn.
void AttemptLog::add(const Attempt& attempt) {
  append_to_file(file_, "\n" + line_of(attempt));
  attempts_.push_back(attempt);
}

}  // namespace tinsmith
