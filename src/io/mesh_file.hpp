#pragma once
// Mesh files by extension: .ply .obj .glb .2dm. One format has one source file each, ply.cpp, obj.cpp, ...

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "geodesy/grid_frame.hpp"
#include "geometry/colour.hpp"
#include "mesh/terrain_mesh.hpp"
#include "tinsmith/tin.hpp"

namespace tinsmith {

/// Whether the extension of the path is that of a mesh file, in small or capital letters.
bool is_mesh_path(const std::string& path);

/// Throws UsageError when the extension of the path is none that can be written; names those that can.
void require_mesh_extension(const std::string& path);

/// The largest change of a height (vertical units) that writing heights within [lowest, highest] to the
/// format of this path may cause: half a step of float32 about the local origin for .glb, 0 for the others.
/// Plan positions are exact in every format.
double height_rounding(const std::string& path, double lowest, double highest);

/// Throws ResourceError when the format of this path can't hold so many vertices and triangles; says which can.
/// What passes here has a size that write_mesh can write. Only .glb has a limit: 4 GiB.
void require_format_holds(const std::string& path, std::uint64_t n_vertices, std::uint64_t n_triangles);

/// About how many bytes write_mesh will write, with colours of so many channels (0: none); for text an estimate, by
/// numbers of common length.
std::uint64_t expected_mesh_bytes(const std::string& path, std::uint64_t n_vertices, std::uint64_t n_triangles,
                                  int n_channels);

/// Throws UsageError when the format of this path can't hold vertices with colours of so many channels (0: none);
/// says which can. .ply and .glb hold all, .obj those without alpha, .2dm none.
void require_format_holds_colour(const std::string& path, int n_channels);

/// Throws OutputError when the CRS of a mesh in the format of this path goes into a .prj and one is there that says
/// another CRS. write_mesh does, too; this tells before the work.
void require_place_for_crs(const std::string& path, const std::string& crs_wkt);

/// Writes aside and renames when whole, so that a failed write leaves the previous file as it was. Writes the
/// .prj companion of .obj and .2dm the same way, unless it is there. The bytes depend on the arguments only, the
/// path excluded. Goes through the vertices once and through the triangles once, in a few MB of memory. Throws
/// OutputError (with the system's reason), and ResourceError before a byte is written when the format can't hold
/// the mesh. Colours become whole levels of red, green and blue: grey is all three alike, the second of two and the
/// fourth of four channels is alpha. .ply: uchar properties; .glb: COLOR_0, linear in 16 bits; .obj: fractions of
/// 255 behind the coordinates.
void write_mesh(const std::string& path, const TerrainSurface& surface, const GridFrame& frame);
void write_mesh(const std::string& path, const TerrainMesh& mesh, const GridFrame& frame);

/// Reads any of the written formats back, in the CRS and vertical unit of the input that it was made from
/// (GLB: undoing the node's transform and the metres that its extras declare). Throws InputError, with the
/// place of the damage, for anything that is not a whole, valid file: never crashes on garbage. Throws
/// ResourceError when there are more vertices than a Tin can number. `colours`, when given, gets the levels of red,
/// green and blue of all vertices, or nothing where the file has none.
Tin read_mesh(const std::string& path, std::vector<Levels>* colours = nullptr);

/// The same block by block, in a few MB for meshes that need not fit in memory: all vertices in their order, then
/// all triangles in theirs. Everything is checked before it is handed over.
struct MeshVisitor {
  std::function<void(std::span<const std::array<double, 3>>)> vertices;
  std::function<void(std::span<const std::array<std::uint64_t, 3>>)> triangles;
  /// May be empty. Called before all else when the file says how many there are and is long enough for them.
  std::function<void(std::uint64_t n_vertices, std::uint64_t n_triangles)> counts = nullptr;
  /// May be empty. Called for files with colours only, before `vertices` with the same block: levels of red, green,
  /// blue, and of alpha when n_channels is 4, not 3.
  std::function<void(std::span<const Levels>, int n_channels)> colours = nullptr;
  /// May be empty. Called when the file says how many metres a unit of its heights is.
  std::function<void(double metres)> height_unit = nullptr;
};

/// Returns the CRS as WKT, empty when unknown.
std::string visit_mesh(const std::string& path, const MeshVisitor& visitor);

}  // namespace tinsmith
