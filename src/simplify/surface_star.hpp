#pragma once
// What a step of one vertex, or the collapse of an edge into one, does to the triangles around.

#include <array>
#include <vector>

#include "geometry/half_space_test.hpp"
#include "simplify/surface_mesh.hpp"

namespace tinsmith {

/// Triangles around one vertex, or around the two ends of an edge without those at the edge. Counter-clockwise: the
/// next side begins where a side ends, but for gaps at borders.
struct SurfaceStar {
  std::vector<LinkSide> sides;
  std::vector<Vec<3>> beyond;               // by side: the normal of the triangle there; zero: none
  std::vector<std::array<Vec<3>, 3>> gone;  // the triangles at the edge
};

void clear(SurfaceStar& star);
/// Adds the triangle of h, whose vertex at the origin of h moves.
void add_side(const SurfaceMesh& mesh, std::int32_t h, SurfaceStar& star);
/// Adds the triangle of h, which goes.
void add_gone(const SurfaceMesh& mesh, std::int32_t h, SurfaceStar& star);

/// Edges of the star whose triangles have normals more than 90 degrees apart: as it is, and with the vertex at p.
int count_turned(const SurfaceStar& star);
int count_turned(const SurfaceStar& star, const Vec<3>& p);

/// Whether there are more of them with the vertex at p.
bool turns_more(const SurfaceStar& star, const Vec<3>& p);

double squared_distance(const Vec<3>& q, const std::array<Vec<3>, 3>& triangle);
/// From q to the triangles of the star with the vertex at p. What is at most `enough` need not be the least.
double squared_distance(const Vec<3>& q, const SurfaceStar& star, const Vec<3>& p, double enough);
/// The farthest from the star as it is, among middles of the triangles and of their inner sides with the vertex at
/// p.
double squared_distance_back(const SurfaceStar& star, const Vec<3>& p);

}  // namespace tinsmith
