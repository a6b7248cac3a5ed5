#pragma once
// Where the new vertex of a collapsed edge goes, and what that costs.

#include <array>

#include "geometry/colour.hpp"
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

  void add(const Candidate& candidate) { list[static_cast<std::size_t>(n++)] = candidate; }
};

/// One end of an edge.
struct EdgeEnd {
  LatticePoint position;
  double height = 0;
  VertexKind kind = VertexKind::kInterior;
  VerticalQuadric quadric;
};

/// The quadrics of a vertex, one for each channel of its colour, in height units.
using ChannelQuadrics = std::array<VerticalQuadric, kMaxChannels>;

/// The colour of an edge, in height units.
struct EdgeColour {
  std::size_t n_channels = 0;
  std::array<double, kMaxChannels> rise{};  // from v0 to v1
  ChannelQuadrics v0;
  ChannelQuadrics v1;
};

/// An edge as its placement sees it.
struct Edge {
  EdgeEnd v0;
  EdgeEnd v1;
  bool is_border = false;              // has one triangle only
  const EdgeColour* colour = nullptr;  // none: height alone counts
};

struct PlacementRules {
  Placement placement = Placement::kOptimal;
  // A slope (height units per cell) that means nothing at the tolerance: where the surface is flatter than that,
  // the new vertex keeps to the middle of the edge.
  double slope_noise = 0;
};

/// The quadric error (of height and colour) of the edge's new vertex where it is least under the rules of the
/// vertex kinds; infinity when the edge never collapses.
double edge_cost(const Edge& edge, const PlacementRules& rules);

/// Where to try to put the new vertex.
Candidates place(const Edge& edge, const PlacementRules& rules);

}  // namespace tinsmith
