#include "io/raster_inputs.hpp"

#include <algorithm>
#include <limits>

#include "io/raster_blocks.hpp"
#include "samples/grid_rect.hpp"

namespace tinsmith {
namespace {

template <typename Function>
void for_each_block(const RasterSource& source, const GridRect& rect, Function function) {
  for (std::int64_t y = rect.y0; y < rect.y0 + rect.height;) {
    const GridRect left = block_around(source, rect.x0, static_cast<std::int32_t>(y));
    for (std::int64_t x = rect.x0; x < rect.x0 + rect.width;) {
      const GridRect block = block_around(source, static_cast<std::int32_t>(x), static_cast<std::int32_t>(y));
      function(block);
      x = static_cast<std::int64_t>(block.x0) + block.width;
    }
    y = static_cast<std::int64_t>(left.y0) + left.height;
  }
}

std::vector<double> voids(const GridRect& rect) {
  return std::vector<double>(static_cast<std::size_t>(rect.area()), std::numeric_limits<double>::quiet_NaN());
}

void copy_part(const std::vector<double>& heights, const GridRect& part, const GridRect& rect,
               std::vector<double>& z) {
  for (std::int64_t row = 0; row < part.height; ++row) {
    const std::int64_t to = (part.y0 + row - rect.y0) * rect.width + (part.x0 - rect.x0);
    std::copy_n(heights.begin() + row * part.width, part.width, z.begin() + to);
  }
}

}  // namespace

bool RasterInputs::add(const std::string& path, const InputOptions& options) {
  GDALDatasetUniquePtr dataset;
  try {
    dataset = open_raster(path);
  } catch (const UnreadableError&) {
    if (!skip_) throw;
    unopened_.push_back(path);
    return false;
  }
  sources_.push_back(read_source(*dataset, path, options));
  pool_.add(path, std::move(dataset));
  return true;
}

// Before the dataset is given back: it may keep a block that failed as if it had been read, or take a tile that it
// can't open for a void without saying so again.
template <typename Ask>
auto RasterInputs::noting_damage(std::size_t input, Ask ask) const {
  try {
    return ask();
  } catch (const UnreadableError&) {
    const std::lock_guard lock(mutex_);
    if (skip_) damage_.try_emplace(input);
    throw;
  }
}

bool RasterInputs::is_surely_void(std::size_t input, const GridRect& rect) const {
  if (!sources_[input].knows_voids || is_damaged(input)) return false;
  try {
    const DatasetPool::Loan dataset(pool_, input, stripes_of(sources_[input], rect).front().stripe);
    return noting_damage(input, [&] { return tinsmith::is_surely_void(*dataset, sources_[input], rect); });
  } catch (const UnreadableError&) {
    if (!skip_) throw;
    return false;  // read() says more
  }
}

std::vector<double> RasterInputs::read(std::size_t input, const GridRect& rect) const {
  if (is_damaged(input)) return read_sound_blocks(input, rect);
  try {
    return read_stripes(input, rect);
  } catch (const UnreadableError&) {
    if (!skip_) throw;
  }
  return read_sound_blocks(input, rect);
}

std::vector<double> RasterInputs::read_stripes(std::size_t input, const GridRect& rect) const {
  const RasterSource& source = sources_[input];
  const std::vector<StripePart> parts = stripes_of(source, rect);
  std::vector<double> z;
  for (const StripePart& part : parts) {
    const DatasetPool::Loan dataset(pool_, input, part.stripe);
    std::vector<double> heights = noting_damage(input, [&] {
      const bool is_void = tinsmith::is_surely_void(*dataset, source, part.rect);
      return is_void ? std::vector<double>() : read_heights(*dataset, source, part.rect);
    });
    if (parts.size() == 1) return heights;
    if (heights.empty()) continue;
    if (z.empty()) z = voids(rect);
    copy_part(heights, part.rect, rect, z);
  }
  return z;
}

std::vector<double> RasterInputs::read_sound_blocks(std::size_t input, const GridRect& rect) const {
  const RasterSource& source = sources_[input];
  std::vector<double> z = voids(rect);
  for_each_block(source, rect, [&](const GridRect& block) {
    if (!is_readable(input, block)) return;
    const GridRect part = intersection(block, rect);
    const DatasetPool::Loan dataset(pool_, input, stripes_of(source, part).front().stripe);
    copy_part(read_heights(*dataset, source, part), part, rect, z);
  });
  return z;
}

// Judged by a dataset that has read nothing else, hence holds nothing of an earlier failure.
bool RasterInputs::is_readable(std::size_t input, const GridRect& block) const {
  const Corner corner{block.x0, block.y0};
  {
    const std::lock_guard lock(mutex_);
    const Damage& known = damage_[input];
    if (known.readable.contains(corner)) return true;
    if (known.unreadable.contains(corner)) return false;
  }
  bool is_read = true;
  try {
    const RasterSource& source = sources_[input];
    read_heights(*open_raster(source.path), source, block);
  } catch (const UnreadableError&) {
    is_read = false;
  }
  const std::lock_guard lock(mutex_);
  Damage& damage = damage_[input];
  (is_read ? damage.readable : damage.unreadable).insert(corner);
  return is_read;
}

bool RasterInputs::is_damaged(std::size_t input) const {
  if (!skip_) return false;
  const std::lock_guard lock(mutex_);
  return damage_.contains(input);
}

Unreadable RasterInputs::unreadable() const {
  Unreadable result{unopened_, 0};
  const std::lock_guard lock(mutex_);
  for (const auto& [input, damage] : damage_) {
    if (damage.unreadable.empty()) continue;
    const RasterSource& source = sources_[input];
    result.paths.push_back(source.path);
    for (const auto& [x, y] : damage.unreadable) {
      result.n_samples += static_cast<std::uint64_t>(block_around(source, x, y).area());
    }
  }
  return result;
}

}  // namespace tinsmith
