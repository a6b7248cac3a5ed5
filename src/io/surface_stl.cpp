#include "io/surface_stl.hpp"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

#include "io/input_file.hpp"
#include "io/output_file.hpp"
#include "io/surface_text.hpp"
#include "tinsmith/error.hpp"

namespace tinsmith {
namespace {

static_assert(std::endian::native == std::endian::little, "STL is written in the machine's byte order");

using Place = std::array<double, 3>;

constexpr std::uint64_t kHeaderBytes = 80;
constexpr std::uint64_t kStartBytes = kHeaderBytes + sizeof(std::uint32_t);

// A facet: its normal and three corners, and two bytes that mean nothing.
using FacetNumbers = std::array<float, 12>;
using FacetPadding = std::uint16_t;
constexpr std::uint64_t kFacetBytes = sizeof(FacetNumbers) + sizeof(FacetPadding);

// ---- reading

/// Gives corners at the same place the same vertex, in the order in which the places first come.
class Welder {
 public:
  explicit Welder(std::vector<Place>& places) : places_(places), slots_(1024, kEmpty) {}

  std::uint32_t vertex_at(Place place) {
    for (double& coordinate : place) coordinate += 0.0;  // -0 is at 0
    if (2 * places_.size() >= slots_.size()) grow();
    std::uint32_t& slot = slots_[find(place)];
    if (slot == kEmpty) {
      slot = static_cast<std::uint32_t>(places_.size());
      places_.push_back(place);
    }
    return slot;
  }

 private:
  static constexpr std::uint32_t kEmpty = std::numeric_limits<std::uint32_t>::max();

  using Bits = std::array<std::uint64_t, 3>;
  static Bits bits(const Place& place) { return std::bit_cast<Bits>(place); }

  /// Mixes as the finish of MurmurHash3 does.
  static std::uint64_t hash(const Place& place) {
    std::uint64_t h = 0;
    for (const std::uint64_t coordinate : bits(place)) {
      h = (h ^ coordinate) * 0xff51afd7ed558ccdU;
      h ^= h >> 33U;
    }
    return h;
  }

  /// Where the place is in the table, or belongs. Bits are compared, so that what is no number finds itself too.
  std::size_t find(const Place& place) const {
    std::size_t s = hash(place) & (slots_.size() - 1);
    while (slots_[s] != kEmpty && bits(places_[slots_[s]]) != bits(place)) s = (s + 1) & (slots_.size() - 1);
    return s;
  }

  void grow() {
    slots_.assign(2 * slots_.size(), kEmpty);
    for (std::size_t v = 0; v < places_.size(); ++v) slots_[find(places_[v])] = static_cast<std::uint32_t>(v);
  }

  std::vector<Place>& places_;
  std::vector<std::uint32_t> slots_;  // by hash; a power of two of them
};

Surface read_binary(InputFile& file) {
  std::array<char, kHeaderBytes> title;
  file.read(title.data(), title.size());
  const auto n_triangles = file.read<std::uint32_t>();
  // A third of 2^32 is where the corners could have more places than an index has values.
  if (n_triangles > std::numeric_limits<std::uint32_t>::max() / 3) file.fail("has more triangles than fit");
  Surface surface;
  surface.triangles.reserve(n_triangles);
  surface.position.reserve(n_triangles / 2 + 2);  // what a closed surface has
  Welder welder(surface.position);
  for (std::uint32_t t = 0; t < n_triangles; ++t) {
    const auto facet = file.read<FacetNumbers>();
    file.read<FacetPadding>();
    surface.triangles.push_back({welder.vertex_at({facet[3], facet[4], facet[5]}),
                                 welder.vertex_at({facet[6], facet[7], facet[8]}),
                                 welder.vertex_at({facet[9], facet[10], facet[11]})});
  }
  return surface;
}

/// The words of an ascii STL, one after the other; line ends are blanks.
class Words {
 public:
  explicit Words(InputFile& file) : file_(file) {}

  /// Empty at the end of the file; in small letters.
  const std::string& next() {
    std::string_view word = take_word(line_);
    while (word.empty() && file_.read_line(line_, LastLine::kMayLackEnd)) word = take_word(line_);
    word_ = word;
    for (char& c : word_) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return word_;
  }

  void expect(std::string_view wanted) {
    if (next() != wanted) file_.fail(fmt::format("the STL lacks '{}' where it belongs", wanted));
  }

  Place next_place() {
    Place place;
    for (double& coordinate : place) coordinate = number_of(file_, next());
    return place;
  }

  void skip_line() { line_ = {}; }

 private:
  InputFile& file_;
  std::string_view line_;  // what is left of it
  std::string word_;
};

void read_facet(Words& words, Welder& welder, std::array<std::uint32_t, 3>& triangle) {
  words.expect("normal");
  words.skip_line();  // some write nan for a triangle without area
  words.expect("outer");
  words.expect("loop");
  for (std::uint32_t& corner : triangle) {
    words.expect("vertex");
    corner = welder.vertex_at(words.next_place());
  }
  words.expect("endloop");
  words.expect("endfacet");
}

/// Solids, one or more.
Surface read_ascii(InputFile& file) {
  Surface surface;
  Welder welder(surface.position);
  Words words(file);
  std::string word = words.next();
  if (word != "solid")
    file.fail("is no STL: neither as long as the count of a binary one says, nor text that starts with 'solid'");
  while (word == "solid") {
    words.skip_line();  // the name
    for (word = words.next(); word == "facet"; word = words.next()) {
      if (surface.position.size() > std::numeric_limits<std::uint32_t>::max() - 4)
        file.fail("has more vertices than fit");
      read_facet(words, welder, surface.triangles.emplace_back());
    }
    if (word != "endsolid") file.fail("the STL has neither 'facet' nor 'endsolid' where one belongs");
    words.skip_line();
    word = words.next();
  }
  if (!word.empty()) file.fail("the STL goes on after 'endsolid'");
  return surface;
}

/// Whether the file is as long as a binary STL with its count is. Binary files may start with "solid" too.
bool is_binary(const std::string& path) {
  InputFile file(path);
  if (file.size() < kStartBytes) return false;
  std::array<char, kHeaderBytes> title;
  file.read(title.data(), title.size());
  return file.size() == kStartBytes + std::uint64_t{file.read<std::uint32_t>()} * kFacetBytes;
}

// ---- writing

using Corners = std::array<std::array<float, 3>, 3>;

/// Of unit length; 0 0 0 without an area.
std::array<float, 3> facet_normal(const Corners& corners) {
  const auto& [a, b, c] = corners;
  std::array<double, 3> u;
  std::array<double, 3> w;
  for (std::size_t k = 0; k < 3; ++k) {
    u[k] = double{b[k]} - a[k];
    w[k] = double{c[k]} - a[k];
  }
  const std::array<double, 3> n{u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2], u[0] * w[1] - u[1] * w[0]};
  const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  if (!(length > 0)) return {};
  return {static_cast<float>(n[0] / length), static_cast<float>(n[1] / length), static_cast<float>(n[2] / length)};
}

void require_fits(const std::string& path, const Surface& surface) {
  if (surface.triangles.size() > std::numeric_limits<std::uint32_t>::max())
    throw ResourceError(path + ": STL counts its triangles up to 2^32 only; write .ply instead");
  for (const Place& place : surface.position)
    for (const double coordinate : place)
      if (!(std::abs(coordinate) <= std::numeric_limits<float>::max()))
        throw ResourceError(
            fmt::format("{}: {} is beyond the float32 of STL; write .ply instead", path, coordinate));
}

}  // namespace

Surface read_surface_stl(const std::string& path) {
  const bool has_binary_size = is_binary(path);
  InputFile file(path);
  return has_binary_size ? read_binary(file) : read_ascii(file);
}

void write_surface_stl(const std::string& path, const Surface& surface) {
  require_fits(path, surface);
  OutputFile file(path);
  std::string title = "tinsmith";  // never "solid": some take that for text
  title.resize(kHeaderBytes, ' ');
  file.write(title);
  const auto n_triangles = static_cast<std::uint32_t>(surface.triangles.size());
  file.write(&n_triangles, sizeof n_triangles);
  for (const auto& triangle : surface.triangles) {
    Corners corners;
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t axis = 0; axis < 3; ++axis)
        corners[k][axis] = static_cast<float>(surface.position[triangle[k]][axis]);
    const std::array<float, 3> normal = facet_normal(corners);
    file.write(normal.data(), sizeof normal);
    file.write(corners.data(), sizeof corners);
    const FacetPadding padding = 0;
    file.write(&padding, sizeof padding);
  }
  file.commit();
}

}  // namespace tinsmith
