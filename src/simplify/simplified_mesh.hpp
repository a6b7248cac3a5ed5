#pragma once
// The simplification of a surface with all that it did: what a progressive mesh is made of.

#include <array>
#include <cstdint>
#include <vector>

#include "simplify/surface_attributes.hpp"
#include "simplify/surface_mesh.hpp"

namespace tinsmith {

/// One collapse, in wedges and triangles of the surface mesh.
struct SurfaceCollapse {
  struct Moved {
    std::int32_t kept = kNone;
    std::int32_t gone = kNone;
    std::vector<std::int32_t> triangles;  // whose corner was `gone` and is `kept` now
  };
  struct Removed {
    std::int32_t triangle = kNone;
    std::array<std::int32_t, 3> wedges{};  // before
  };
  std::vector<Moved> moved;
  std::vector<Removed> removed;
};

/// The mesh and its values after simplify_surface's collapses; they are added to `history` in order, if that is
/// given.
SurfaceMesh simplified_mesh(const Surface& surface, const SimplifySurfaceOptions& options,
                            SimplifySurfaceReport& report, WedgeValues& values,
                            std::vector<SurfaceCollapse>* history);

}  // namespace tinsmith
