#include "inputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <optional>

#include "io/colour_raster.hpp"
#include "io/mesh_file.hpp"
#include "io/raster_field.hpp"
#include "io/raster_list.hpp"
#include "text.hpp"
#include "tinsmith/error.hpp"

namespace tinsmith::cli {
namespace {

std::uint64_t samples_of(const RasterField& field) {
  constexpr std::int32_t kSide = 1024;
  std::uint64_t n_samples = 0;
  for (std::int64_t y = 0; y < field.height(); y += kSide) {
    for (std::int64_t x = 0; x < field.width(); x += kSide) {
      const auto width = static_cast<std::int32_t>(std::min<std::int64_t>(kSide, field.width() - x));
      const auto height = static_cast<std::int32_t>(std::min<std::int64_t>(kSide, field.height() - y));
      const GridRect rect{static_cast<std::int32_t>(x), static_cast<std::int32_t>(y), width, height};
      if (!field.is_surely_void(rect)) n_samples += static_cast<std::uint64_t>(rect.area());
    }
  }
  return n_samples;
}

}  // namespace

OpenedInputs open_inputs(const std::vector<std::string>& paths, const InputOptions& options,
                         const std::string& color) {
  const RasterField field(paths, options);
  OpenedInputs opened;
  opened.n_samples = samples_of(field);
  const std::optional<std::string> overlaps = field.remark_on_overlaps();  // may find damage, which remarks() tells
  opened.remarks = field.remarks();
  if (overlaps) opened.remarks.push_back(*overlaps);
  if (color.empty()) return opened;
  const ColourRaster colours(color, field.frame(), field.width(), field.height());
  if (const auto remark = colours.remark()) opened.remarks.push_back(*remark);
  return opened;
}

std::vector<std::string> files_read(const std::vector<std::string>& paths) {
  std::vector<std::string> files = expand_lists(paths);
  for (const std::string& path : paths)
    if (path.starts_with('@')) files.push_back(path.substr(1));
  return files;
}

void print_remarks(const std::vector<std::string>& remarks, bool quiet) {
  if (quiet) return;
  for (const std::string& remark : remarks) std::fprintf(stderr, "tinsmith: %s\n", in_one_line(remark).c_str());
}

void require_rasters(const std::vector<std::string>& paths, const char* order) {
  for (const std::string& path : paths)
    if (is_mesh_path(path))
      throw UsageError(fmt::format("{}: a mesh where a raster belongs; the order is {}", path, order));
}

}  // namespace tinsmith::cli
