#include "io/raster_field.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/mosaic.hpp"
#include "io/raster_dataset.hpp"
#include "io/raster_frame.hpp"
#include "io/raster_source.hpp"
#include "samples/grid_rect.hpp"

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

void void_outside(HeightGrid& grid, const GridRect& part, const GridFrame& frame, const Bbox& bbox) {
  for_each_row(grid, part, [&](std::int32_t row, double* z) {
    for (std::int32_t i = 0; i < part.width; ++i) {
      if (!is_inside(frame, part.x0 + i, row, bbox)) z[i] = std::numeric_limits<double>::quiet_NaN();
    }
  });
}

}  // namespace

struct RasterField::Impl {
  explicit Impl(const std::vector<std::string>& paths) : pool(paths) {}

  std::vector<RasterSource> sources;
  Mosaic mosaic;
  std::optional<Bbox> mask;  // of a turned grid, whose crop also holds samples outside the box
  std::vector<std::string> remarks;
  mutable DatasetPool pool;
};

RasterField::RasterField(const std::vector<std::string>& paths, const InputOptions& options)
    : impl_(std::make_unique<Impl>(paths)) {
  std::vector<PlacedRaster> rasters;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const DatasetPool::Loan dataset(impl_->pool, i);
    const RasterSource& source = impl_->sources.emplace_back(read_source(*dataset, paths[i], options));
    rasters.push_back({paths[i], frame_of(source, options, impl_->remarks), source.width, source.height});
  }
  impl_->mosaic = lay_out(rasters);
  if (!options.bbox) return;
  impl_->mosaic = crop(impl_->mosaic, *options.bbox);
  if (is_turned(impl_->mosaic.frame)) impl_->mask = options.bbox;
}

RasterField::~RasterField() = default;

std::int32_t RasterField::width() const { return impl_->mosaic.width; }

std::int32_t RasterField::height() const { return impl_->mosaic.height; }

const GridFrame& RasterField::frame() const { return impl_->mosaic.frame; }

const std::vector<std::string>& RasterField::remarks() const { return impl_->remarks; }

HeightGrid RasterField::read(const GridRect& rect) const {
  HeightGrid grid = void_grid(rect);
  const GridRect inside = intersection(rect, {0, 0, width(), height()});
  for (std::size_t i = 0; i < impl_->sources.size(); ++i) {
    const GridRect& place = impl_->mosaic.places[i];
    const GridRect part = intersection(inside, place);
    if (is_empty(part) || !has_void(grid, part)) continue;
    const DatasetPool::Loan dataset(impl_->pool, i);
    const GridRect in_file{part.x0 - place.x0, part.y0 - place.y0, part.width, part.height};
    fill_voids(grid, part, read_heights(*dataset, impl_->sources[i], in_file));
  }
  if (impl_->mask) void_outside(grid, inside, frame(), *impl_->mask);
  return grid;
}

}  // namespace tinsmith
