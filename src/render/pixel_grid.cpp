#include "render/pixel_grid.hpp"

#include <algorithm>
#include <cmath>

#include "tinsmith/error.hpp"

namespace tinsmith {
namespace {

constexpr int kPlacesPerSide = 3;  // of a pixel, where a mesh is asked for its height
constexpr int kMeshBand = 64;      // pixel rows at a time

// A rectangle of grid positions about a place.
struct Footprint {
  double column, row;
  std::array<double, 2> radius;
  std::int32_t x0, y0, x1, y1;  // inclusive
};

Footprint footprint(const View& view, const RasterField& field, const std::array<int, 2>& pixel,
                    const std::array<double, 2>& radius) {
  const auto [x, y] = view.to_crs(pixel[0] + 0.5, pixel[1] + 0.5);
  const auto [column, row] = field.frame().to_grid(x, y);
  return {column,
          row,
          radius,
          static_cast<std::int32_t>(std::ceil(column - radius[0])),
          static_cast<std::int32_t>(std::ceil(row - radius[1])),
          static_cast<std::int32_t>(std::floor(column + radius[0])),
          static_cast<std::int32_t>(std::floor(row + radius[1]))};
}

// The outer half of a border cell lies beyond all sample centres and takes the height of its nearest ones.
Footprint pulled_inside(Footprint f, const RasterField& field) {
  f.column = std::clamp(f.column, 0.0, field.width() - 1.0);
  f.row = std::clamp(f.row, 0.0, field.height() - 1.0);
  f.x0 = std::max(static_cast<std::int32_t>(std::ceil(f.column - f.radius[0])), 0);
  f.y0 = std::max(static_cast<std::int32_t>(std::ceil(f.row - f.radius[1])), 0);
  f.x1 = std::min(static_cast<std::int32_t>(std::floor(f.column + f.radius[0])), field.width() - 1);
  f.y1 = std::min(static_cast<std::int32_t>(std::floor(f.row + f.radius[1])), field.height() - 1);
  return f;
}

bool lies_on(const Footprint& f, const RasterField& field) {
  return f.column >= -0.5 && f.row >= -0.5 && f.column <= field.width() - 0.5 && f.row <= field.height() - 0.5;
}

void set_weighted_mean(PixelGrid& pixels, std::size_t i, const Footprint& f, const HeightGrid& samples) {
  double sum = 0;
  double weight = 0;
  double all = 0;
  for (std::int32_t y = f.y0; y <= f.y1; ++y) {
    const double wy = 1 - std::abs(y - f.row) / f.radius[1];
    for (std::int32_t x = f.x0; x <= f.x1; ++x) {
      const double w = wy * (1 - std::abs(x - f.column) / f.radius[0]);
      const double z = samples.at(x, y);
      all += w;
      if (std::isnan(z)) continue;
      sum += w * z;
      weight += w;
    }
  }
  if (weight <= 0) return;
  pixels.value[i] = sum / weight;
  pixels.coverage[i] = static_cast<float>(weight / all);
}

void widen_range(PixelGrid& pixels, const std::vector<double>& heights) {
  for (const double z : heights) {
    if (z < pixels.lowest) pixels.lowest = z;
    if (z > pixels.highest) pixels.highest = z;
  }
}

void to_metres(PixelGrid& pixels, double metres_per_vertical_unit) {
  for (double& z : pixels.value) z *= metres_per_vertical_unit;
  pixels.lowest *= metres_per_vertical_unit;
  pixels.highest *= metres_per_vertical_unit;
}

void set_largest(PixelGrid& pixels, std::size_t i, const Footprint& f, const HeightGrid& errors) {
  double largest = std::nan("");
  for (std::int32_t y = f.y0; y <= f.y1; ++y) {
    for (std::int32_t x = f.x0; x <= f.x1; ++x) {
      const double error = errors.at(x, y);
      if (!std::isnan(error) && !(std::abs(error) <= std::abs(largest))) largest = error;
    }
  }
  pixels.value[i] = largest;
  pixels.coverage[i] = std::isnan(largest) ? 0 : 1;
}

}  // namespace

void Stage::report(double fraction, std::string_view name) const {
  if (*progress && !(*progress)((number + fraction) / n_stages, name))
    throw Interrupted("render: interrupted; no picture was written");
}

PixelGrid sample_heights(const View& view, const RasterField& field, const Stage& stage) {
  PixelGrid pixels(view.width, view.height);
  const auto density = samples_per_pixel(view, field.frame());
  const std::array<double, 2> radius{std::max(1.0, density[0]), std::max(1.0, density[1])};
  const auto parts = tiles(view, density);
  for (std::size_t t = 0; t < parts.size(); ++t) {
    stage.report(static_cast<double>(t) / parts.size(), "hillshade");
    const PixelRect& tile = parts[t];
    const HeightGrid samples = field.read(samples_under(view, field.frame(), tile, radius, field));
    widen_range(pixels, samples.z);
    for (int y = tile.y0; y < tile.y0 + tile.height; ++y) {
      for (int x = tile.x0; x < tile.x0 + tile.width; ++x) {
        const Footprint f = footprint(view, field, {x, y}, radius);
        if (lies_on(f, field)) set_weighted_mean(pixels, pixels.index(x, y), pulled_inside(f, field), samples);
      }
    }
  }
  to_metres(pixels, field.frame().metres_per_vertical_unit);
  return pixels;
}

PixelGrid mesh_heights(const View& view, const Tin& tin, double metres_per_vertical_unit, const Stage& stage) {
  PixelGrid pixels(view.width, view.height);
  // Integer positions of the plane are the places asked: kPlacesPerSide of them along a pixel.
  const PlanTin plan = make_plan_tin(tin, [&](double x, double y) -> std::array<double, 2> {
    const auto [px, py] = view.to_pixel(x, y);
    return {px * kPlacesPerSide - 0.5, py * kPlacesPerSide - 0.5};
  });
  for (int y0 = 0; y0 < view.height; y0 += kMeshBand) {
    stage.report(static_cast<double>(y0) / view.height, "hillshade");
    const int n_rows = std::min(kMeshBand, view.height - y0);
    const HeightGrid places =
        heights_at(plan, {0, y0 * kPlacesPerSide, view.width * kPlacesPerSide, n_rows * kPlacesPerSide});
    widen_range(pixels, places.z);
    for (int y = y0; y < y0 + n_rows; ++y) {
      for (int x = 0; x < view.width; ++x) {
        const double middle = (kPlacesPerSide - 1) / 2.0;
        const int left = x * kPlacesPerSide;
        const int top = y * kPlacesPerSide;
        const Footprint f{left + middle,           top + middle, {1e9, 1e9}, left, top, left + kPlacesPerSide - 1,
                          top + kPlacesPerSide - 1};
        set_weighted_mean(pixels, pixels.index(x, y), f, places);
      }
    }
  }
  to_metres(pixels, metres_per_vertical_unit);
  return pixels;
}

PixelColours mesh_colours(const View& view, const Tin& tin, const std::vector<Levels>& colours,
                          const Stage& stage) {
  Tin flat = tin;  // with a level in place of each height
  const auto channel = [&](std::size_t c) {
    for (std::size_t v = 0; v < colours.size(); ++v) flat.vertices[v][2] = static_cast<double>(colours[v][c]);
    return mesh_heights(view, flat, 1, stage);
  };
  return {{channel(0), channel(1), channel(2)}};
}

PixelGrid largest_errors(const View& view, const RasterField& field, const Tin& tin, const Stage& stage) {
  PixelGrid pixels(view.width, view.height);
  const GridFrame& frame = field.frame();
  const auto density = samples_per_pixel(view, frame);
  // Half a pixel and a little, so that no sample falls between two pixels.
  const std::array<double, 2> radius{std::max(0.5, density[0] / 2) * 1.001, std::max(0.5, density[1] / 2) * 1.001};
  const PlanTin plan = make_plan_tin(tin, [&](double x, double y) { return frame.to_grid(x, y); });
  const auto parts = tiles(view, density);
  for (std::size_t t = 0; t < parts.size(); ++t) {
    stage.report(static_cast<double>(t) / parts.size(), "error map");
    const PixelRect& tile = parts[t];
    HeightGrid errors = heights_at(plan, samples_under(view, frame, tile, radius, field));
    const HeightGrid samples = field.read(errors.rect);
    for (std::size_t i = 0; i < errors.z.size(); ++i)
      errors.z[i] = (errors.z[i] - samples.z[i]) * frame.metres_per_vertical_unit;
    for (int y = tile.y0; y < tile.y0 + tile.height; ++y)
      for (int x = tile.x0; x < tile.x0 + tile.width; ++x)
        set_largest(pixels, pixels.index(x, y), footprint(view, field, {x, y}, radius), errors);
  }
  return pixels;
}

}  // namespace tinsmith
