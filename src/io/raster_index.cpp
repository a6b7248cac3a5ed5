#include "io/raster_index.hpp"

#include <algorithm>
#include <numeric>

#include "samples/grid_rect.hpp"

namespace tinsmith {
namespace {

constexpr std::uint32_t kLeaf = 8;  // places that are quicker looked at than parted

std::int64_t twice_middle(const GridRect& rect, bool along_x) {
  return along_x ? 2LL * rect.x0 + rect.width : 2LL * rect.y0 + rect.height;
}

GridRect around(const GridRect& a, const GridRect& b) {
  const std::int32_t x0 = std::min(a.x0, b.x0);
  const std::int32_t y0 = std::min(a.y0, b.y0);
  return {x0, y0, std::max(a.x0 + a.width, b.x0 + b.width) - x0, std::max(a.y0 + a.height, b.y0 + b.height) - y0};
}

}  // namespace

RasterIndex::RasterIndex(const std::vector<GridRect>& places) : places_(places), order_(places.size()) {
  std::iota(order_.begin(), order_.end(), 0U);
  if (!places.empty()) build(0, static_cast<std::uint32_t>(places.size()));
}

void RasterIndex::build(std::uint32_t first, std::uint32_t last) {
  GridRect box = places_[order_[first]];
  for (std::uint32_t i = first + 1; i < last; ++i) box = around(box, places_[order_[i]]);
  const std::size_t node = nodes_.size();
  nodes_.push_back({box, first, last - first, 0});
  if (last - first <= kLeaf) return;
  const std::uint32_t middle = first + (last - first) / 2;
  const bool along_x = box.width > box.height;
  std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                   [&](std::uint32_t a, std::uint32_t b) {
                     return twice_middle(places_[a], along_x) < twice_middle(places_[b], along_x);
                   });
  build(first, middle);
  nodes_[node].right = static_cast<std::uint32_t>(nodes_.size());
  build(middle, last);
}

void RasterIndex::collect(std::uint32_t node, const GridRect& rect, std::vector<std::uint32_t>& found) const {
  const Node& here = nodes_[node];
  if (is_empty(intersection(here.box, rect))) return;
  if (here.right != 0) {
    collect(node + 1, rect, found);
    collect(here.right, rect, found);
    return;
  }
  for (std::uint32_t i = here.first; i < here.first + here.n_places; ++i) {
    if (!is_empty(intersection(places_[order_[i]], rect))) found.push_back(order_[i]);
  }
}

std::vector<std::uint32_t> RasterIndex::touching(const GridRect& rect) const {
  std::vector<std::uint32_t> found;
  if (!nodes_.empty()) collect(0, rect, found);
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace tinsmith
