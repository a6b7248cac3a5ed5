#pragma once
// Where the new vertex of a collapsed edge goes, and what that costs.

#include <array>

#include "geometry/vertical_quadric.hpp"
#include "mesh/window_mesh.hpp"
#include "tinsmith/options.hpp"

namespace tinsmith {

/// A place to try: a lattice point, and its height when that is not free.
struct Candidate {
  LatticePoint position;
  double height = 0;  // the quadric's optimum, or the fixed height
  bool has_fixed_height = false;
};

/// The candidates of an edge, the best first; none: the edge never collapses.
struct Candidates {
  std::array<Candidate, 3> list;
  int n = 0;
  double cost = 0;  // quadric error of the first

  void add(const Candidate& candidate) { list[static_cast<std::size_t>(n++)] = candidate; }
};

/// One end of an edge.
struct EdgeEnd {
  LatticePoint position;
  double height = 0;
  VertexKind kind = VertexKind::kInterior;
  const VerticalQuadric* quadric = nullptr;
};

/// The candidates of the edge (v0, v1) under the rules of the vertex kinds. `is_border_edge` tells whether it
/// has one triangle only. `slope_noise`: a slope (height units per cell) that means nothing at the tolerance;
/// where the surface is flatter than that, the new vertex keeps to the middle of the edge.
Candidates place(const EdgeEnd& v0, const EdgeEnd& v1, bool is_border_edge, Placement placement,
                 double slope_noise);

}  // namespace tinsmith
