#pragma once
// Options whose value is one of a few words.

#include <fmt/format.h>

#include <map>
#include <string>

#include "tinsmith/error.hpp"
#include "tinsmith/options.hpp"

namespace tinsmith::cli {

/// What the word stands for. Throws UsageError, which names the words that there are.
template <class Choice>
Choice choose(const std::string& flag, const std::string& name, const std::map<std::string, Choice>& choices) {
  if (const auto choice = choices.find(name); choice != choices.end()) return choice->second;
  std::string names;
  for (const auto& [known, value] : choices) names += (names.empty() ? "" : ", ") + known;
  throw UsageError(fmt::format("{} {}: there is no such; use one of {}", flag, name, names));
}

inline Placement choose_placement(const std::string& name) {
  return choose<Placement>(
      "--placement", name,
      {{"optimal", Placement::kOptimal}, {"segment", Placement::kSegment}, {"subset", Placement::kSubset}});
}

}  // namespace tinsmith::cli
