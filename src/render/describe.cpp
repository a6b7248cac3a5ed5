#include "tinsmith/describe.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <limits>
#include <numeric>

#include "geodesy/crs.hpp"
#include "io/mesh_file.hpp"
#include "io/raster_description.hpp"
#include "io/raster_field.hpp"
#include "io/raster_list.hpp"
#include "render/view.hpp"
#include "tinsmith/error.hpp"
#include "tinsmith/progressive.hpp"
#include "tinsmith/surface.hpp"

namespace tinsmith {
namespace {

using Entries = std::vector<std::pair<std::string, std::string>>;

constexpr std::int32_t kBlockSide = 2048;  // samples read at a time

struct HeightRange {
  std::uint64_t n_valid = 0;
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -std::numeric_limits<double>::infinity();

  void add(double z) {
    ++n_valid;
    lowest = std::min(lowest, z);
    highest = std::max(highest, z);
  }
};

HeightRange range_of(const HeightField& field) {
  HeightRange range;
  for (std::int32_t y = 0; y < field.height(); y += kBlockSide) {
    for (std::int32_t x = 0; x < field.width(); x += kBlockSide) {
      const GridRect rect{x, y, std::min(kBlockSide, field.width() - x), std::min(kBlockSide, field.height() - y)};
      if (field.is_surely_void(rect)) continue;
      const HeightGrid block = field.read(rect);
      for (const double z : block.z)
        if (!std::isnan(z)) range.add(z);
    }
  }
  return range;
}

std::string heights(const HeightRange& range, double metres_per_vertical_unit) {
  if (range.n_valid == 0) return "none";
  std::string metres = fmt::format("{:.10g} to {:.10g} m", range.lowest * metres_per_vertical_unit,
                                   range.highest * metres_per_vertical_unit);
  if (metres_per_vertical_unit == 1) return metres;
  return fmt::format("{:.10g} to {:.10g} units of {:.10g} m: {}", range.lowest, range.highest,
                     metres_per_vertical_unit, metres);
}

std::string heights_of_unknown_unit(const HeightRange& range) {
  if (range.n_valid == 0) return "none";
  return fmt::format("{:.10g} to {:.10g}, in a unit that the file does not say; --vertical-unit says it",
                     range.lowest, range.highest);
}

// The name stands in the first pair of quotes, in every dialect of WKT; an EPSG code in the last brackets.
std::string crs_name(const std::string& wkt) {
  if (wkt.empty()) return "none";
  const std::size_t open = wkt.find('"');
  const std::size_t close = wkt.find('"', open + 1);
  if (close == std::string::npos) return "unnamed";
  std::string name = wkt.substr(open + 1, close - open - 1);
  const std::size_t authority = wkt.rfind("[\"EPSG\",");
  if (authority == std::string::npos) return name;
  std::string code = wkt.substr(authority + std::string_view("[\"EPSG\",").size());
  code.erase(std::remove(code.begin(), code.end(), '"'), code.end());
  const bool is_of_the_whole = code.ends_with("]]") && code.find(']') == code.size() - 2;
  return is_of_the_whole ? fmt::format("{} (EPSG:{})", name, code.substr(0, code.size() - 2)) : name;
}

std::string extent_text(const Extent& e) {
  return fmt::format("west {:.12g}, south {:.12g}, east {:.12g}, north {:.12g}", e[0], e[1], e[2], e[3]);
}

std::string horizontal_unit(const std::string& crs_wkt, const std::string& path) {
  return crs_wkt.empty() ? "metre (no CRS)" : crs_units(crs_wkt, path).horizontal_unit;
}

bool is_list(const std::string& path) { return path.starts_with('@'); }

Entries describe_list(const std::string& path, const RasterField& field) {
  return {{"format", fmt::format("list of {} inputs", expand_lists({path}).size())},
          {"size", fmt::format("{} x {} samples in all", field.width(), field.height())}};
}

Entries describe_raster(const std::string& path, const InputOptions& options) {
  const RasterField field({path}, options);
  Entries entries = is_list(path) ? describe_list(path, field) : describe_raster_file(path, options);
  const GridFrame& frame = field.frame();
  const double middle_column = field.width() / 2.0;
  const double middle_row = field.height() / 2.0;
  const auto units = frame.metres_per_unit(middle_column, middle_row);
  const auto metres = frame.metres_per_step(middle_column, middle_row);
  const HeightRange range = range_of(field);
  const double n_samples = static_cast<double>(field.width()) * field.height();
  if (options.bbox)
    entries.emplace_back("in the bbox", fmt::format("{} x {} samples", field.width(), field.height()));
  entries.emplace_back("CRS", crs_name(frame.crs_wkt));
  entries.emplace_back("CRS unit", fmt::format("{}; {:.10g} m across, {:.10g} m down in the middle",
                                               horizontal_unit(frame.crs_wkt, path), units[0], units[1]));
  entries.emplace_back("step", fmt::format("{:.10g} x {:.10g} units, {:.6g} x {:.6g} m in the middle",
                                           metres[0] / units[0], metres[1] / units[1], metres[0], metres[1]));
  entries.emplace_back("extent", extent_text(grid_extent(frame, field.width(), field.height())));
  entries.emplace_back("heights", heights(range, frame.metres_per_vertical_unit));
  entries.emplace_back("valid", fmt::format("{} samples, {:.4g} %", range.n_valid,
                                            100 * static_cast<double>(range.n_valid) / n_samples));
  for (const std::string& remark : field.remarks()) entries.emplace_back("remark", remark);
  return entries;
}

// Parts that share no vertex: each vertex points towards the first of its part.
std::uint64_t count_components(const Tin& tin) {
  std::vector<std::uint32_t> parent(tin.vertices.size());
  std::iota(parent.begin(), parent.end(), 0U);
  const auto root = [&](std::uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  std::vector<bool> is_used(tin.vertices.size());
  for (const auto& t : tin.triangles) {
    for (const std::uint32_t v : t) is_used[v] = true;
    for (const int k : {1, 2}) {
      const auto [low, high] = std::minmax({root(t[0]), root(t[k])});
      parent[high] = low;
    }
  }
  std::uint64_t n_components = 0;
  for (std::uint32_t v = 0; v < parent.size(); ++v) n_components += is_used[v] && parent[v] == v ? 1 : 0;
  return n_components;
}

Entries describe_mesh(const std::string& path, const InputOptions& options) {
  const Tin tin = read_mesh(path);
  const CrsUnits units = crs_units(tin.crs_wkt, path);
  const bool is_known = tin.metres_per_height || options.vertical_unit;
  HeightRange range;
  Extent extent = no_extent();
  for (const auto& [x, y, z] : tin.vertices) {
    extent = grown(extent, {x, y});
    range.add(z);
  }
  Entries entries{{"format", fmt::format("mesh, {}", path.substr(path.rfind('.')))},
                  {"vertices", fmt::format("{}", tin.vertices.size())},
                  {"triangles", fmt::format("{}", tin.triangles.size())},
                  {"components", fmt::format("{}", count_components(tin))},
                  {"CRS", crs_name(tin.crs_wkt)},
                  {"CRS unit", horizontal_unit(tin.crs_wkt, path)}};
  if (range.n_valid > 0) entries.emplace_back("extent", extent_text(extent));
  entries.emplace_back("heights", is_known ? heights(range, metres_per_height(tin, units, options))
                                           : heights_of_unknown_unit(range));
  return entries;
}

std::string extension_of(const std::string& path) {
  std::string text = std::filesystem::path(path).extension().string();
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

std::string values_of(const Surface& surface) {
  std::vector<std::string> names;
  for (const SurfaceAttribute& one : surface.attributes)
    names.push_back(one.kind == AttributeKind::kColour   ? "colours"
                    : one.kind == AttributeKind::kNormal ? "normals"
                                                         : one.name);
  return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

Entries describe_surface(const std::string& format, const Surface& surface) {
  Entries entries{{"format", format},
                  {"vertices", fmt::format("{}", surface.position.size())},
                  {"triangles", fmt::format("{}", surface.triangles.size())},
                  {"values", values_of(surface)}};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    HeightRange range;
    for (const auto& position : surface.position) range.add(position[axis]);
    entries.emplace_back(std::string(1, "xyz"[axis]),
                         fmt::format("{:.10g} to {:.10g}", range.lowest, range.highest));
  }
  return entries;
}

Entries describe_progressive(const std::string& path) {
  const ProgressiveSurface progressive = read_progressive(path);
  return describe_surface(fmt::format("progressive mesh, .tspm, of any resolution from {} triangles",
                                      progressive.base.triangles.size()),
                          restore(progressive));
}

// A mesh of another program, or of simplify, which has no CRS.
Entries describe_any_surface(const std::string& path) {
  return describe_surface("surface, " + extension_of(path), read_surface(path));
}

}  // namespace

Entries describe(const std::string& path, const InputOptions& options) {
  const std::string extension = extension_of(path);
  if (is_list(path)) return describe_raster(path, options);
  if (extension == ".tspm") return describe_progressive(path);
  if (extension == ".stl") return describe_any_surface(path);
  if (!is_mesh_path(path)) return describe_raster(path, options);
  if (extension == ".2dm") return describe_mesh(path, options);
  try {
    return describe_mesh(path, options);
  } catch (const InputError&) {
    return describe_any_surface(path);
  }
}

}  // namespace tinsmith
