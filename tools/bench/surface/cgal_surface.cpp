// cgal_surface gh|lt IN.ply TRIANGLES OUT.ply: CGAL's edge collapse of a surface down to a count of triangles.
// gh: Garland and Heckbert's plane quadrics with the filter that keeps normals from turning over, as the CGAL
// manual recommends; lt: Lindstrom and Turk's cost and placement (CGAL's default). Its own seconds are from
// triangles to triangles, as those of the other tools; of them, collapse_seconds are without its mesh.

#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Bounded_normal_change_filter.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/GarlandHeckbert_plane_policies.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_placement.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include <cstdio>
#include <exception>
#include <string>

#include "plain_ply.hpp"

namespace {

namespace simplification = CGAL::Surface_mesh_simplification;
using Kernel = CGAL::Simple_cartesian<double>;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;

/// CGAL's own stop predicates count edges.
struct TriangleCount {
  std::size_t n_triangles;
  template <class Cost, class Profile>
  bool operator()(const Cost&, const Profile& profile, std::size_t, std::size_t) const {
    return profile.surface_mesh().number_of_faces() <= n_triangles;
  }
};

/// Where more than one fan or more than two triangles meet it is cut apart, since Surface_mesh has no such places.
SurfaceMesh surface_mesh_of(const bench::Mesh& plain) {
  std::vector<Kernel::Point_3> points;
  points.reserve(plain.vertices.size());
  for (const auto& [x, y, z] : plain.vertices) points.emplace_back(x, y, z);
  std::vector<std::vector<std::size_t>> soup;
  soup.reserve(plain.triangles.size());
  for (const auto& t : plain.triangles) soup.push_back({t[0], t[1], t[2]});
  CGAL::Polygon_mesh_processing::orient_polygon_soup(points, soup);
  SurfaceMesh mesh;
  CGAL::Polygon_mesh_processing::polygon_soup_to_polygon_mesh(points, soup, mesh);
  return mesh;
}

bench::Mesh plain(SurfaceMesh& mesh) {
  mesh.collect_garbage();
  bench::Mesh result;
  for (const auto v : mesh.vertices()) {
    const auto& p = mesh.point(v);
    result.vertices.push_back({p.x(), p.y(), p.z()});
  }
  for (const auto f : mesh.faces()) {
    const auto h = mesh.halfedge(f);
    result.triangles.push_back({mesh.source(h), mesh.target(h), mesh.target(mesh.next(h))});
  }
  return result;
}

void garland_heckbert(SurfaceMesh& mesh, const TriangleCount& stop) {
  using Policies = simplification::GarlandHeckbert_plane_policies<SurfaceMesh, Kernel>;
  const Policies policies(mesh);
  simplification::edge_collapse(mesh, stop,
                                CGAL::parameters::get_cost(policies.get_cost())
                                    .get_placement(policies.get_placement())
                                    .filter(simplification::Bounded_normal_change_filter<>()));
}

void lindstrom_turk(SurfaceMesh& mesh, const TriangleCount& stop) {
  simplification::edge_collapse(mesh, stop,
                                CGAL::parameters::get_cost(simplification::LindstromTurk_cost<SurfaceMesh>())
                                    .get_placement(simplification::LindstromTurk_placement<SurfaceMesh>()));
}

void run(const std::string& method, const std::string& input, const TriangleCount& stop,
         const std::string& output) {
  const bench::Mesh original = bench::read_plain_ply(input);
  const bench::Stopwatch watch;
  SurfaceMesh mesh = surface_mesh_of(original);
  const bench::Stopwatch collapse_watch;
  if (method == "gh") {
    garland_heckbert(mesh, stop);
  } else {
    lindstrom_turk(mesh, stop);
  }
  const double collapse_seconds = collapse_watch.seconds();
  const bench::Mesh result = plain(mesh);
  const double seconds = watch.seconds();
  bench::write_plain_ply(output, result);
  std::printf("{\"own_seconds\":%.6f,\"collapse_seconds\":%.6f,\"triangles\":%zu}\n", seconds, collapse_seconds,
              result.triangles.size());
}

}  // namespace

int main(int argc, char** argv) {
  const std::string method = argc == 5 ? argv[1] : "";
  if (method != "gh" && method != "lt") {
    std::fprintf(stderr, "usage: cgal_surface gh|lt IN.ply TRIANGLES OUT.ply\n");
    return 2;
  }
  try {
    run(method, argv[2], {std::stoul(argv[3])}, argv[4]);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "cgal_surface: %s\n", error.what());
    return 1;
  }
}
