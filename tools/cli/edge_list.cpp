#include "edge_list.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>
#include <string_view>

#include "tinsmith/error.hpp"

namespace tinsmith::cli {
namespace {

struct Line {
  const std::string& path;
  std::size_t number;  // from 1

  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("{}: line {}: {}; write two vertex numbers a line", path, number, what));
  }
};

std::string_view without_comment(std::string_view text) {
  text = text.substr(0, text.find('#'));
  const std::size_t end = text.find_last_not_of(" \t\r");
  return end == std::string_view::npos ? std::string_view() : text.substr(0, end + 1);
}

/// The first number of the text, which it is taken from.
std::uint32_t take_vertex(std::string_view& text, std::size_t n_vertices, const Line& line) {
  text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
  std::uint64_t vertex = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), vertex);
  const auto length = static_cast<std::size_t>(end - text.data());
  if (error == std::errc::invalid_argument || (length < text.size() && text[length] != ' ' && text[length] != '\t'))
    line.fail("there is no vertex number where one belongs");
  if (error != std::errc() || vertex >= n_vertices)
    line.fail(fmt::format("there is no vertex {} among {}, counted from 0", text.substr(0, length), n_vertices));
  text.remove_prefix(length);
  return static_cast<std::uint32_t>(vertex);
}

}  // namespace

std::vector<std::array<std::uint32_t, 2>> read_edge_list(const std::string& path, std::size_t n_vertices) {
  std::ifstream file(path);
  if (!file) throw InputError(fmt::format("{}: {}; name a text file of edges", path, std::strerror(errno)));
  std::vector<std::array<std::uint32_t, 2>> edges;
  std::string text;
  for (std::size_t number = 1; std::getline(file, text); ++number) {
    const Line line{path, number};
    std::string_view rest = without_comment(text);
    if (rest.find_first_not_of(" \t") == std::string_view::npos) continue;
    const std::uint32_t from = take_vertex(rest, n_vertices, line);
    const std::uint32_t to = take_vertex(rest, n_vertices, line);
    if (!rest.empty()) line.fail("there is more than an edge");
    if (from == to) line.fail(fmt::format("vertex {} makes no edge with itself", from));
    edges.push_back({from, to});
  }
  if (file.bad()) throw InputError(fmt::format("{}: can't be read to its end; is it a file?", path));
  return edges;
}

}  // namespace tinsmith::cli
