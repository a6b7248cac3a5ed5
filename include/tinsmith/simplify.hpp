#pragma once
// The paper's algorithm for any surface: edge collapse by quadric error with a half-space test, attributes, borders
// and feature edges.

#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "tinsmith/options.hpp"
#include "tinsmith/progress.hpp"
#include "tinsmith/surface.hpp"

namespace tinsmith {

/// How geometry and attributes share a quadric. tools/bench/surface/RESULTS.md has the errors of colour and
/// geometry of all three at their default weights. Of smooth colours combined quadrics and gradients make the same,
/// separate ones, blind to where a value lies, lose up to a half of the distance; of a checker gradients have the
/// better colour at the same distance.
enum class QuadricForm {
  kSeparate,  // one each, in three dimensions: 20 coefficients with one attribute (the paper, eq. 25-28)
  // One in six dimensions: 28 coefficients (Garland and Heckbert 1998). The first colour or normal has weight,
  // other attributes follow.
  kCombined,
  kGradient,  // attributes as linear functions of the place: 23 coefficients (Hoppe 1999)
};

/// When to stop: at the first that is reached; without any, when no edge can be collapsed.
struct SimplifySurfaceOptions {
  std::optional<double> triangles;  // at most so many
  std::optional<double> ratio;      // the same as a fraction (0 to 1] of the input's
  std::optional<double> max_cost;   // no collapse that costs more (mean squared distance, square units of the mesh)
  Placement placement = Placement::kOptimal;
  // Planes count by the area of their triangles and twice the mean area; false: all the same (eq. 3 as printed).
  bool area_weights = true;
  // Eq. 12-24: no triangle may turn over, nor an edge get normals more than 90 degrees apart where there was none.
  bool half_space = true;
  // With optimal placement, at the end: vertices and values move to the best fit of the input's vertices, and edges
  // flip where that is nearer to them, which takes a tenth to a fifth off the RMS distance and as long as the
  // collapses at most. Places that get farther off than the farthest was, one way or the other, are drawn back.
  // Nothing turns over; features stay.
  bool fit = true;
  QuadricForm quadric = QuadricForm::kGradient;
  // alpha of Cost = E_g + alpha E_c, the geometry in units of its largest extent; 0: attributes follow and cost
  // nothing. Default: 1 for separate quadrics, 3e-7 for combined ones and where no number of triangles is asked
  // for, else 0.22 x the cube of the length of the result's edges (the root of its triangles' mean area), and down
  // to a tenth of it where the shape is smooth (with the fit).
  std::optional<double> attribute_weight;
  std::optional<double> crease;  // degrees: edges whose triangles meet at more than that are features
  bool keep_seams = true;  // edges along which colours or normals differ are features; false: one side's remain
  std::vector<std::array<std::uint32_t, 2>> feature_edges;  // more of them, by vertices of the input
  Progress progress;
};

/// What was wrong with a surface (definitions 1 to 4 of the paper), and what became of it.
struct SurfaceDefects {
  std::uint64_t duplicated_triangles = 0;   // the same three vertices again: removed
  std::uint64_t degenerate_triangles = 0;   // a vertex twice, or no area: removed where a vertex is twice
  std::uint64_t flipped_triangles = 0;      // against their neighbours' orientation: turned over
  std::uint64_t non_manifold_edges = 0;     // more than two triangles: cut apart, vertices locked
  std::uint64_t non_manifold_vertices = 0;  // more than one fan: cut apart, locked
  std::uint64_t unorientable_edges = 0;     // of a surface like Moebius's: cut apart, locked
  std::uint64_t unreferenced_vertices = 0;  // removed

  bool any() const {
    return duplicated_triangles + degenerate_triangles + flipped_triangles + non_manifold_edges +
               non_manifold_vertices + unorientable_edges + unreferenced_vertices >
           0;
  }
};

/// Why it went no further.
enum class SimplifyStop {
  kNoCandidates,  // no edge is left that can be collapsed
  kTriangles,     // no more than asked for, by number or ratio
  kCost,          // all that is left costs more than max_cost
};

/// What happened.
struct SimplifySurfaceReport {
  SurfaceDefects defects;
  std::uint64_t input_vertices = 0;
  std::uint64_t input_triangles = 0;
  std::uint64_t components = 0;     // of the input, mended: parts that share no edge
  std::uint64_t border_edges = 0;   // of the input
  std::uint64_t feature_edges = 0;  // of the input, borders not counted
  std::uint64_t collapses = 0;
  std::uint64_t refused_topology = 0;  // link condition, corners, features that would be torn
  std::uint64_t refused_half_space = 0;
  double last_cost = 0;  // of the costliest collapse that was made
  SimplifyStop stopped_by = SimplifyStop::kNoCandidates;
};

/// The simplified surface. Throws UsageError for options out of range, InputError for vertex numbers that don't
/// exist, numbers that are not finite, and triangles that all have a corner twice, ResourceError above 2^32 / 3
/// triangles, and Interrupted.
Surface simplify_surface(const Surface& surface, const SimplifySurfaceOptions& options,
                         SimplifySurfaceReport& report);

}  // namespace tinsmith
