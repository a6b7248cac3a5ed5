#pragma once
// Whether triangles are a surface as the paper defines it (definitions 1 to 4), and what can be mended.

#include <cstdint>
#include <vector>

#include "tinsmith/simplify.hpp"
#include "tinsmith/surface.hpp"

namespace tinsmith {

/// A surface in which every edge has at most two triangles, that run along it in opposite directions, and every
/// vertex one fan. What was not so has been cut apart: the pieces keep their places, and their vertices are locked,
/// so that they still meet when it is written.
struct ManifoldSurface {
  Surface surface;
  std::vector<std::uint8_t> is_locked;         // by vertex
  std::vector<std::uint32_t> original_vertex;  // by vertex: the input's
};

/// Counts and mends: removes what is there twice, turns over what is against its neighbours, removes unreferenced
/// vertices, cuts the rest apart. Triangles keep their order. The same vertex numbers mean the same vertex only;
/// nothing is welded by place. Throws InputError for numbers of vertices that don't exist, positions and attributes
/// that aren't finite, and attributes of another length; ResourceError for more than 2^32 / 3 vertices or
/// triangles.
ManifoldSurface manifold_of(const Surface& surface, SurfaceDefects& defects);

}  // namespace tinsmith
