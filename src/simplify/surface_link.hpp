#pragma once
// Whether the collapse of an edge leaves a surface a surface.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "simplify/surface_mesh.hpp"
#include "simplify/surface_star.hpp"

namespace tinsmith {

/// The link condition, and that lines are not folded onto each other nor closed parts flat.
class LinkCondition {
 public:
  explicit LinkCondition(std::size_t n_vertices) : mark_(n_vertices, 0) {}

  /// For the edge of h. Gathers its star in any case: of a closed one the sides follow each other, those of the
  /// origin first. Changes which halfedges are `out` of the ends.
  bool holds(SurfaceMesh& mesh, std::int32_t h, SurfaceStar& star);

 private:
  template <class F>
  std::int32_t add_sides(const SurfaceMesh& mesh, std::int32_t v, std::int32_t other, SurfaceStar& star, F&& f);

  std::vector<std::uint32_t> mark_;  // by vertex
  std::uint32_t mark_now_ = 0;
};

}  // namespace tinsmith
