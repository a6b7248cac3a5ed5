#pragma once
// The other two stops: which tolerance gives a number of triangles.

#include <functional>
#include <memory>
#include <optional>

#include "mesh/terrain_mesh.hpp"
#include "tinsmith/compress.hpp"

namespace tinsmith {

/// A compression with a tolerance in vertical units; fills the report.
using RunAtTolerance =
    std::function<std::shared_ptr<const TerrainSurface>(double tolerance, CompressReport& report)>;

/// What an attempt came to.
struct Attempt {
  double tolerance = 0;              // vertical units
  std::uint64_t triangles = 0;       // of the result
  std::uint64_t full_triangles = 0;  // of the full grid
};

/// How attempts are made, and those that can't give the result any more remembered without their surfaces.
struct Attempts {
  RunAtTolerance run;
  std::function<std::optional<Attempt>(double tolerance)> known{};  // dropped before, also by an earlier run
  std::function<void(const Attempt&)> drop{};                       // its surface is gone already
};

/// The result with the smallest tolerance, among those tried, that has at most so many triangles (or that
/// ratio of the full grid's): the count falls steadily with the tolerance, so it is bracketed and then closed
/// in on until within 1 % below the limit. Throws ResultError when even the largest tolerance leaves more.
std::shared_ptr<const TerrainSurface> search_tolerance(const Attempts& attempts, std::optional<double> triangles,
                                                       std::optional<double> ratio, CompressReport& report);

}  // namespace tinsmith
