#include "triangulate/full_grid.hpp"

#include <algorithm>
#include <cmath>

namespace tinsmith {

namespace {

class FullGrid {
 public:
  FullGrid(const HeightGrid& samples, const GridRect& window)
      : samples_(samples), window_(window), name_(static_cast<std::size_t>(window.area()), kNone) {}

  void add_block(const GridRect& cells) {
    for (std::int32_t y = cells.y0; y < cells.y0 + cells.height; ++y) {
      for (std::int32_t x = cells.x0; x < cells.x0 + cells.width; ++x) {
        if (samples_.is_valid_cell(x, y)) add_cell(x, y);
      }
    }
  }

  WindowMesh mesh() && {
    mesh_.is_settled.assign(mesh_.position.size(), 0);
    connect(mesh_, triangles_);
    return std::move(mesh_);
  }

 private:
  // 00 --- 10
  //  |     |
  // 01 --- 11
  void add_cell(std::int32_t x, std::int32_t y) {
    const std::int32_t v00 = name(x, y);
    const std::int32_t v10 = name(x + 1, y);
    const std::int32_t v11 = name(x + 1, y + 1);
    const std::int32_t v01 = name(x, y + 1);
    const double down = std::abs(samples_.at(x, y) - samples_.at(x + 1, y + 1));
    const double up = std::abs(samples_.at(x + 1, y) - samples_.at(x, y + 1));
    if (down <= up) {
      triangles_.push_back({v00, v10, v11});
      triangles_.push_back({v00, v11, v01});
    } else {
      triangles_.push_back({v00, v10, v01});
      triangles_.push_back({v10, v11, v01});
    }
  }

  std::int32_t name(std::int32_t x, std::int32_t y) {
    std::int32_t& name = name_[static_cast<std::size_t>(static_cast<std::int64_t>(y - window_.y0) * window_.width +
                                                        (x - window_.x0))];
    if (name == kNone) {
      name = mesh_.n_vertices();
      mesh_.position.push_back({x * kLatticePerCell, y * kLatticePerCell});
      mesh_.height.push_back(samples_.at(x, y));
    }
    return name;
  }

  const HeightGrid& samples_;
  GridRect window_;
  std::vector<std::int32_t> name_;  // by sample of the window
  WindowMesh mesh_;
  std::vector<std::array<std::int32_t, 3>> triangles_;
};

}  // namespace

WindowMesh full_grid(const HeightGrid& samples, const GridRect& window) {
  // Block by block: what lies together in plan lies together in memory.
  constexpr std::int32_t kBlock = 16;
  FullGrid grid(samples, window);
  const std::int32_t right = window.x0 + window.width - 1;
  const std::int32_t bottom = window.y0 + window.height - 1;
  for (std::int32_t y = window.y0; y < bottom; y += kBlock) {
    for (std::int32_t x = window.x0; x < right; x += kBlock)
      grid.add_block({x, y, std::min(kBlock, right - x), std::min(kBlock, bottom - y)});
  }
  return std::move(grid).mesh();
}

}  // namespace tinsmith
