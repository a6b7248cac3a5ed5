#pragma once
// Which of thousands of rasters lie in a rectangle, without looking at all of them.

#include <cstdint>
#include <vector>

#include "samples/height_grid.hpp"

namespace tinsmith {

/// A tree of rectangles: each node's box holds its places, the halves of a node lie side by side along the longer
/// side of its box. Some 20 bytes a place.
class RasterIndex {
 public:
  RasterIndex() = default;
  /// Places may overlap and may be empty.
  explicit RasterIndex(const std::vector<GridRect>& places);

  /// The places that share a sample with the rectangle, ascending. Thread-safe.
  std::vector<std::uint32_t> touching(const GridRect& rect) const;

 private:
  struct Node {
    GridRect box;
    std::uint32_t first = 0;  // in order_
    std::uint32_t n_places = 0;
    std::uint32_t right = 0;  // node; the left one follows its parent; 0: a leaf
  };

  void build(std::uint32_t first, std::uint32_t last);
  void collect(std::uint32_t node, const GridRect& rect, std::vector<std::uint32_t>& found) const;

  std::vector<GridRect> places_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;  // parents before children
};

}  // namespace tinsmith
