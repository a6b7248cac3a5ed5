#include "pipeline/search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "tinsmith/error.hpp"

namespace tinsmith {

namespace {

constexpr double kStart = 16;      // vertical units; coarse tolerances are the quick ones to try
constexpr double kStep = 8;        // between tolerances while the limit is not bracketed
constexpr double kFinest = 1e-4;   // below this only 0 itself is left to try
constexpr double kCoarsest = 1e9;  // here nothing but the outline is left
constexpr double kClosest = 1.0005;
constexpr double kCloseEnough = 0.99;
constexpr int kMostRuns = 16;

struct Tried {
  double tolerance = 0;
  double triangles = 0;
};

// log(triangles) over log(tolerance) is nearly straight over the ranges that matter; aimed a little below the
// limit, so that one more run is seldom needed.
double between(const Tried& fine, const Tried& coarse, double limit) {
  const double wanted = std::max(0.995 * limit, 1.0);
  const double share = std::log(fine.triangles / wanted) / std::log(fine.triangles / coarse.triangles);
  return fine.tolerance * std::pow(coarse.tolerance / fine.tolerance, std::clamp(share, 0.05, 0.95));
}

// `fine` gave too many triangles, `coarse` few enough; one of them at least has been tried.
std::optional<double> next_tolerance(const std::optional<Tried>& fine, const std::optional<Tried>& coarse,
                                     double limit) {
  if (!coarse) return fine->tolerance < kCoarsest ? std::optional(fine->tolerance * kStep) : std::nullopt;
  if (coarse->triangles >= kCloseEnough * limit || coarse->tolerance == 0) return std::nullopt;
  if (!fine) return coarse->tolerance / kStep < kFinest ? 0 : coarse->tolerance / kStep;
  if (fine->tolerance == 0 || coarse->tolerance / fine->tolerance < kClosest) return std::nullopt;
  return between(*fine, *coarse, limit);
}

}  // namespace

std::shared_ptr<const TerrainSurface> search_tolerance(const RunAtTolerance& run, std::optional<double> triangles,
                                                       std::optional<double> ratio, CompressReport& report) {
  std::optional<Tried> fine;
  std::optional<Tried> coarse;
  std::shared_ptr<const TerrainSurface> best;
  std::optional<double> tolerance = kStart;
  for (int i = 0; tolerance && i < kMostRuns; ++i) {
    CompressReport now;
    now.remarks = report.remarks;  // each attempt may have found damage
    auto surface = run(*tolerance, now);
    const double limit = triangles ? *triangles : *ratio * static_cast<double>(now.full_triangles);
    const Tried tried{*tolerance, static_cast<double>(surface->extent().n_triangles)};
    if (tried.triangles <= limit) {
      coarse = tried;
      best = std::move(surface);
      report = std::move(now);
    } else {
      fine = tried;
      report.remarks = std::move(now.remarks);
    }
    tolerance = next_tolerance(fine, coarse, limit);
  }
  if (!coarse)
    throw ResultError(
        fmt::format("{} triangles remain at any tolerance, for the outline of the valid area and the "
                    "windows' size; ask for at least as many, or choose a larger window",
                    fine->triangles));
  return best;
}

}  // namespace tinsmith
