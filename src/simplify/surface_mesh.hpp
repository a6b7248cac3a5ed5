#pragma once
// A surface as its simplification sees it: topology of places, and attributes of wedges.
//
// A wedge is what the corners around a vertex share that have the same attributes (Hoppe 1999): one on smooth
// ground, two where a seam of the attributes passes. In files each wedge is a vertex of its own.

#include <array>
#include <cstdint>
#include <vector>

#include "geometry/quadric.hpp"
#include "mesh/halfedges.hpp"
#include "tinsmith/simplify.hpp"
#include "tinsmith/surface.hpp"

namespace tinsmith {

/// What a vertex of a surface may do, by rising rank: of an edge's ends the higher stays where it is.
enum class SurfaceVertexKind : std::uint8_t {
  kInterior,
  kFeature,  // on one feature line or border: collapses along it only
  kCorner,   // where lines meet, end or turn sharply: stays
  kLocked,   // where the input is no surface: stays
};

struct SurfaceMesh : Halfedges {
  // by vertex
  std::vector<Vec<3>> position;  // about the middle, in units of the largest extent
  std::vector<SurfaceVertexKind> kind;
  // by halfedge
  std::vector<std::uint8_t> is_feature;  // feature lines and borders, on both halfedges
  std::vector<std::int32_t> wedge;       // of the corner at its origin
  // by wedge
  std::vector<std::uint32_t> original_vertex;  // the input's
  // by triangle: in this order they are in the input
  std::vector<std::uint32_t> original_triangle;

  Vec<3> middle{};
  double extent = 1;
  double mean_area = 0;  // of the input's triangles
};

/// A place of the input in the mesh's coordinates.
Vec<3> scaled(const SurfaceMesh& mesh, const Vec<3>& p);

/// The places of the corners of a halfedge's triangle, from its origin on.
std::array<Vec<3>, 3> corners_of(const SurfaceMesh& mesh, std::int32_t h);

/// The two other sides of the triangle of h are about to become one edge, a line when one of them is.
void carry_feature(SurfaceMesh& mesh, std::int32_t h);

/// Whether the two triangles at the edge of h have different wedges there.
bool is_seam(const SurfaceMesh& mesh, std::int32_t h);

/// Of the triangle of a halfedge.
double triangle_area(const SurfaceMesh& mesh, std::int32_t h);

/// The surface welded by place, so far as that leaves it a manifold with borders, with its defects mended and
/// counted. Vertices come along a space-filling curve, triangles and wedges by them: what lies together in space
/// lies together in memory.
SurfaceMesh surface_mesh_of(const Surface& surface, SurfaceDefects& defects);

/// Parts that share no edge.
std::uint64_t count_components(const SurfaceMesh& mesh);

/// Marks borders, creases, seams of the attributes and the given edges (vertices of the input), and from them the
/// kinds of all vertices. Counts them in the report.
void mark_features(SurfaceMesh& mesh, const SimplifySurfaceOptions& options, SimplifySurfaceReport& report);

}  // namespace tinsmith
