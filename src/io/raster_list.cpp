#include "io/raster_list.hpp"

#include <fmt/format.h>

#include <fstream>

#include "tinsmith/error.hpp"

namespace tinsmith {
namespace {

// Lists made elsewhere end their lines with a carriage return and the last with blanks.
std::string without_end(std::string line) {
  line.erase(line.find_last_not_of(" \t\r") + 1);
  return line;
}

void add_list(const std::string& list, std::vector<std::string>& paths) {
  std::ifstream file(list);
  const std::size_t n_before = paths.size();
  for (std::string line; std::getline(file, line);) {
    line = without_end(std::move(line));
    if (!line.empty()) paths.push_back(std::move(line));
  }
  if (!file.eof()) throw InputError(fmt::format("@{}: the list of inputs can't be read; check the path", list));
  if (paths.size() > n_before) return;
  throw InputError(fmt::format("@{}: the list of inputs is empty; write one path a line", list));
}

}  // namespace

std::vector<std::string> expand_lists(const std::vector<std::string>& paths) {
  std::vector<std::string> expanded;
  for (const std::string& path : paths) {
    if (path.starts_with('@')) {
      add_list(path.substr(1), expanded);
    } else {
      expanded.push_back(path);
    }
  }
  return expanded;
}

}  // namespace tinsmith
