#include "io/raster_field.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/mosaic.hpp"
#include "io/raster_blocks.hpp"
#include "io/raster_frame.hpp"
#include "io/raster_index.hpp"
#include "io/raster_inputs.hpp"
#include "io/raster_list.hpp"
#include "io/raster_overlap.hpp"
#include "samples/grid_rect.hpp"
#include "tinsmith/error.hpp"

namespace tinsmith {
namespace {

// The part of a grid that lies in a rectangle, row by row.
template <typename Function>
void for_each_row(HeightGrid& grid, const GridRect& part, Function function) {
  for (std::int32_t row = part.y0; row < part.y0 + part.height; ++row) {
    double* first = grid.z.data() + static_cast<std::int64_t>(row - grid.rect.y0) * grid.rect.width;
    function(row, first + (part.x0 - grid.rect.x0));
  }
}

bool has_void(HeightGrid& grid, const GridRect& part) {
  bool found = false;
  for_each_row(grid, part, [&](std::int32_t, const double* z) {
    found = found || std::any_of(z, z + part.width, [](double v) { return std::isnan(v); });
  });
  return found;
}

void fill_voids(HeightGrid& grid, const GridRect& part, const std::vector<double>& heights) {
  const double* from = heights.data();
  for_each_row(grid, part, [&](std::int32_t, double* z) {
    for (std::int32_t i = 0; i < part.width; ++i, ++from) {
      if (std::isnan(z[i])) z[i] = *from;
    }
  });
}

void add_valid(HeightGrid& sums, HeightGrid& counts, const GridRect& part, const std::vector<double>& heights) {
  const double* from = heights.data();
  for_each_row(sums, part, [&](std::int32_t row, double* sum) {
    const std::int64_t at = static_cast<std::int64_t>(row - part.y0);
    double* n = counts.z.data() + (part.y0 - counts.rect.y0 + at) * counts.rect.width + (part.x0 - counts.rect.x0);
    for (std::int32_t i = 0; i < part.width; ++i, ++from) {
      if (std::isnan(*from)) continue;
      sum[i] = n[i] > 0 ? sum[i] + *from : *from;
      n[i] += 1;
    }
  });
}

void void_outside(HeightGrid& grid, const GridRect& part, const GridFrame& frame, const Bbox& bbox) {
  for_each_row(grid, part, [&](std::int32_t row, double* z) {
    for (std::int32_t i = 0; i < part.width; ++i) {
      if (!is_inside(frame, part.x0 + i, row, bbox)) z[i] = std::numeric_limits<double>::quiet_NaN();
    }
  });
}

std::string remark_on_unreadable(const Unreadable& unreadable) {
  constexpr std::size_t kNamed = 3;
  const std::size_t n = unreadable.paths.size();
  const auto named = unreadable.paths.begin() + static_cast<std::ptrdiff_t>(std::min(n, kNamed));
  const std::string others = n > kNamed ? fmt::format(" and {} others", n - kNamed) : "";
  const std::string samples =
      unreadable.n_samples > 0
          ? fmt::format(" (with {} samples of files that could be opened)", unreadable.n_samples)
          : "";
  return fmt::format("{} {} can't be read and {} left as a void{}: {}{}", n, n == 1 ? "input" : "inputs",
                     n == 1 ? "is" : "are", samples, fmt::join(unreadable.paths.begin(), named, ", "), others);
}

}  // namespace

struct RasterField::Impl {
  explicit Impl(const InputOptions& options) : overlap(options.overlap), inputs(options.skip_unreadable) {}

  void open(const std::vector<std::string>& paths, const InputOptions& options);
  void fill(HeightGrid& grid, const GridRect& inside, std::vector<std::uint32_t> touched) const;
  void fill_with_means(HeightGrid& grid, const GridRect& inside, const std::vector<std::uint32_t>& touched) const;
  GridRect in_file(std::size_t input, const GridRect& rect) const {
    const GridRect& place = mosaic.places[input];
    return {rect.x0 - place.x0, rect.y0 - place.y0, rect.width, rect.height};
  }
  GridRect inside(const GridRect& rect) const { return intersection(rect, {0, 0, mosaic.width, mosaic.height}); }

  Overlap overlap;
  RasterInputs inputs;
  Mosaic mosaic;
  RasterIndex index;
  std::optional<Bbox> mask;  // of a turned grid, whose crop also holds samples outside the box
  std::vector<std::string> remarks;
};

void RasterField::Impl::open(const std::vector<std::string>& paths, const InputOptions& options) {
  std::vector<PlacedRaster> rasters;
  CrsUnits crs;
  for (const std::string& path : paths) {
    if (!inputs.add(path, options)) continue;
    RasterSource& source = inputs.last();
    // Reading a CRS takes as long as opening the file, and thousands of tiles have the same.
    if (rasters.empty() || source.crs_wkt != rasters.back().frame.crs_wkt) crs = crs_units(source.crs_wkt, path);
    rasters.push_back({path, frame_of(source, crs, options, remarks), source.width, source.height});
    source.crs_wkt = {};  // a kilobyte for each of thousands
  }
  if (rasters.empty() && !paths.empty()) {
    throw InputError(fmt::format("none of the {} inputs can be read, the first is {}; check the paths",
                                 paths.size(), paths.front()));
  }
  mosaic = lay_out(rasters);
}

// The valid height of the input that comes first in the order of precedence.
void RasterField::Impl::fill(HeightGrid& grid, const GridRect& inside, std::vector<std::uint32_t> touched) const {
  if (overlap == Overlap::kLast) std::reverse(touched.begin(), touched.end());
  for (const std::uint32_t input : touched) {
    const GridRect part = intersection(inside, mosaic.places[input]);
    if (input != touched.front() && !has_void(grid, part)) continue;
    const std::vector<double> heights = inputs.read(input, in_file(input, part));
    if (!heights.empty()) fill_voids(grid, part, heights);
  }
}

void RasterField::Impl::fill_with_means(HeightGrid& grid, const GridRect& inside,
                                        const std::vector<std::uint32_t>& touched) const {
  HeightGrid counts{grid.rect, std::vector<double>(grid.z.size(), 0)};
  for (const std::uint32_t input : touched) {
    const GridRect part = intersection(inside, mosaic.places[input]);
    const std::vector<double> heights = inputs.read(input, in_file(input, part));
    if (!heights.empty()) add_valid(grid, counts, part, heights);
  }
  for (std::size_t i = 0; i < grid.z.size(); ++i) {
    if (counts.z[i] > 1) grid.z[i] /= counts.z[i];
  }
}

RasterField::RasterField(const std::vector<std::string>& paths, const InputOptions& options)
    : impl_(std::make_unique<Impl>(options)) {
  impl_->open(expand_lists(paths), options);
  if (options.bbox) {
    impl_->mosaic = crop(impl_->mosaic, *options.bbox);
    if (is_turned(impl_->mosaic.frame)) impl_->mask = options.bbox;
  }
  impl_->index = RasterIndex(impl_->mosaic.places);
  if (auto remark = remark_on_blocks(impl_->inputs.sources())) impl_->remarks.push_back(std::move(*remark));
}

RasterField::~RasterField() = default;

std::int32_t RasterField::width() const { return impl_->mosaic.width; }

std::int32_t RasterField::height() const { return impl_->mosaic.height; }

const GridFrame& RasterField::frame() const { return impl_->mosaic.frame; }

std::vector<std::string> RasterField::remarks() const {
  std::vector<std::string> all = impl_->remarks;
  const Unreadable unreadable = impl_->inputs.unreadable();
  if (!unreadable.paths.empty()) all.push_back(remark_on_unreadable(unreadable));
  return all;
}

std::optional<std::string> RasterField::remark_on_overlaps() const {
  const OverlapReport report = compare_overlaps(impl_->inputs, impl_->index, impl_->mosaic);
  return tinsmith::remark_on_overlaps(report, impl_->inputs, frame());
}

std::uint64_t RasterField::n_unreadable() const { return impl_->inputs.unreadable().paths.size(); }

std::uint64_t RasterField::cache_for(std::int64_t width, std::int64_t height) const {
  return tinsmith::cache_for(impl_->inputs.sources(), width, height);
}

HeightGrid RasterField::read(const GridRect& rect) const {
  HeightGrid grid = void_grid(rect);
  const GridRect inside = impl_->inside(rect);
  std::vector<std::uint32_t> touched = impl_->index.touching(inside);
  if (impl_->overlap == Overlap::kMean && touched.size() > 1) {
    impl_->fill_with_means(grid, inside, touched);
  } else {
    impl_->fill(grid, inside, std::move(touched));
  }
  if (impl_->mask) void_outside(grid, inside, frame(), *impl_->mask);
  return grid;
}

bool RasterField::is_surely_void(const GridRect& rect) const {
  const GridRect inside = impl_->inside(rect);
  const std::vector<std::uint32_t> touched = impl_->index.touching(inside);
  return std::all_of(touched.begin(), touched.end(), [&](std::uint32_t input) {
    const GridRect part = intersection(inside, impl_->mosaic.places[input]);
    return impl_->inputs.is_surely_void(input, impl_->in_file(input, part));
  });
}

void set_raster_cache(std::uint64_t bytes) {
  constexpr std::uint64_t kMost = std::numeric_limits<GIntBig>::max();
  GDALSetCacheMax64(static_cast<GIntBig>(std::min(bytes, kMost)));
}

void empty_raster_cache() {
  const GIntBig most = GDALGetCacheMax64();
  GDALSetCacheMax64(0);
  GDALSetCacheMax64(most);
}

}  // namespace tinsmith
