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
// So few triangles stay as many over a range of tolerances (2 from some tolerance on), of which the least is
// wanted: it is found to a hundredth. Of more triangles each is worth less of the tolerance than that.
constexpr double kFew = 100;
constexpr double kCloseToLeast = 1.01;
constexpr int kMostRuns = 16;

// log(triangles) over log(tolerance) is nearly straight over the ranges that matter; aimed a little below the
// limit, so that one more run is seldom needed.
double between(const Attempt& fine, const Attempt& coarse, double limit) {
  const double wanted = std::max(0.995 * limit, 1.0);
  const auto more = static_cast<double>(fine.triangles);
  const double share = std::log(more / wanted) / std::log(more / static_cast<double>(coarse.triangles));
  return fine.tolerance * std::pow(coarse.tolerance / fine.tolerance, std::clamp(share, 0.05, 0.95));
}

// `fine` gave too many triangles, `coarse` few enough; one of them at least has been tried.
std::optional<double> next_tolerance(const std::optional<Attempt>& fine, const std::optional<Attempt>& coarse,
                                     double limit) {
  if (!coarse) return fine->tolerance < kCoarsest ? std::optional(fine->tolerance * kStep) : std::nullopt;
  const bool is_few = limit < kFew;
  if (coarse->tolerance == 0) return std::nullopt;
  if (!is_few && static_cast<double>(coarse->triangles) >= kCloseEnough * limit) return std::nullopt;
  if (!fine) return coarse->tolerance / kStep < kFinest ? 0 : coarse->tolerance / kStep;
  if (fine->tolerance == 0 || coarse->tolerance / fine->tolerance < (is_few ? kCloseToLeast : kClosest))
    return std::nullopt;
  return is_few ? std::sqrt(fine->tolerance * coarse->tolerance) : between(*fine, *coarse, limit);
}

// The attempts so far, as far as they still count.
class Search {
 public:
  Search(const Attempts& attempts, std::optional<double> triangles, std::optional<double> ratio,
         CompressReport& report)
      : attempts_(attempts), triangles_(triangles), ratio_(ratio), report_(report) {}

  void attempt(double tolerance) {
    const auto known = attempts_.known ? attempts_.known(tolerance) : std::nullopt;
    if (!known)
      run(tolerance);
    else if (settle(*known))
      best_.reset();  // there is a better one
  }

  std::optional<double> next() const { return next_tolerance(fine_, coarse_, limit_); }

  std::shared_ptr<const TerrainSurface> result() {
    if (!coarse_)
      throw ResultError(
          fmt::format("{} triangles remain at any tolerance, for the outline of the valid area and the "
                      "windows' size; ask for at least as many, or choose a larger window",
                      fine_->triangles));
    if (!best_) run(coarse_->tolerance);  // what was to replace it is lost
    return best_;
  }

 private:
  void run(double tolerance) {
    CompressReport now;
    now.remarks = report_.remarks;  // each attempt may have found damage
    auto surface = attempts_.run(tolerance, now);
    const Attempt tried{tolerance, surface->extent().n_triangles, now.full_triangles};
    const auto before = coarse_;
    if (settle(tried)) {
      best_ = std::move(surface);
      report_ = std::move(now);
      if (before && before->tolerance != tolerance) drop(*before);
    } else {
      surface.reset();
      report_.remarks = std::move(now.remarks);
      drop(tried);
    }
  }

  // Whether it has few enough triangles.
  bool settle(const Attempt& tried) {
    limit_ = triangles_ ? *triangles_ : *ratio_ * static_cast<double>(tried.full_triangles);
    const bool fits = static_cast<double>(tried.triangles) <= limit_;
    (fits ? coarse_ : fine_) = tried;
    return fits;
  }

  void drop(const Attempt& tried) {
    if (attempts_.drop) attempts_.drop(tried);
  }

  const Attempts& attempts_;
  std::optional<double> triangles_;
  std::optional<double> ratio_;
  CompressReport& report_;
  double limit_ = 0;               // of triangles
  std::optional<Attempt> fine_;    // the last with too many triangles
  std::optional<Attempt> coarse_;  // the last with few enough
  std::shared_ptr<const TerrainSurface> best_;
};

}  // namespace

std::shared_ptr<const TerrainSurface> search_tolerance(const Attempts& attempts, std::optional<double> triangles,
                                                       std::optional<double> ratio, CompressReport& report) {
  Search search(attempts, triangles, ratio, report);
  std::optional<double> tolerance = kStart;
  for (int i = 0; tolerance && i < kMostRuns; ++i) {
    search.attempt(*tolerance);
    tolerance = search.next();
  }
  return search.result();
}

}  // namespace tinsmith
