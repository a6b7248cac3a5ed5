#pragma once
// Colours, normals and scalars in the collapse. Their values live on wedges; how far new values are from the
// surface's is measured by quadrics of one of three forms.

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "geometry/quadric.hpp"
#include "simplify/surface_mesh.hpp"

namespace tinsmith {

/// Two wedges that a collapse makes one.
struct WedgePair {
  std::int32_t w0 = kNone;
  std::int32_t w1 = kNone;
};

/// All attributes of all wedges, in the order of the surface's, so scaled that each has a range of about 1.
struct WedgeValues {
  struct Block {
    AttributeKind kind = AttributeKind::kScalar;
    std::size_t offset = 0;  // of its first component
    double lowest = 0;       // scalars: the file's value is lowest + range x ours
    double range = 1;
  };
  std::vector<Block> blocks;
  std::size_t n_components = 0;
  std::vector<double> values;  // n_components for each wedge

  /// Whether every wedge has the same.
  bool are_all_equal() const {
    const auto n = static_cast<std::ptrdiff_t>(std::min(n_components, values.size()));
    return std::equal(values.begin() + n, values.end(), values.begin());
  }

  std::span<const double> of(std::int32_t w) const {
    return {values.data() + static_cast<std::size_t>(w) * n_components, n_components};
  }
  std::span<double> of(std::int32_t w) {
    return {values.data() + static_cast<std::size_t>(w) * n_components, n_components};
  }
};

WedgeValues wedge_values(const SurfaceMesh& mesh, const Surface& surface);

/// Puts values back into their ranges: colours within [0, 1], normals at unit length.
void put_in_range(const WedgeValues& all, std::span<double> values);

/// The quadrics of all wedges. A place and values have the cost geometry(place) + cost(pair, place, values).
class AttributeQuadrics {
 public:
  AttributeQuadrics() = default;
  AttributeQuadrics(const AttributeQuadrics&) = delete;
  AttributeQuadrics& operator=(const AttributeQuadrics&) = delete;
  virtual ~AttributeQuadrics() = default;

  /// Adds what the best values for each place make the place cost.
  virtual void add_cost_of_place(const WedgePair& pair, Quadric<3>& geometry) const = 0;
  /// Replaces values between those of the pair by the best ones for the place.
  virtual void find_best(const WedgePair& pair, const Vec<3>& place, std::span<double> values) const = 0;
  virtual double cost(const WedgePair& pair, const Vec<3>& place, std::span<const double> values) const = 0;
  /// Adds the quadric of the wedge that goes to that of the one that stays.
  virtual void unite(std::int32_t kept, std::int32_t gone) = 0;
  /// Changes what the costs are multiplied by; only the gradient form can.
  virtual void set_weight(double) {}
};

/// The paper's, eq. 25-28: of each attribute the plane, line or point that a triangle's values span in its own
/// three dimensions; of a scalar the point, where it does not vary.
std::unique_ptr<AttributeQuadrics> separate_quadrics(const SurfaceMesh& mesh, const WedgeValues& all,
                                                     const SimplifySurfaceOptions& options);

/// Garland and Heckbert 1998: the flat of the triangle in six dimensions, place and the first colour or normal; it
/// holds the geometry too. Other attributes cost nothing.
std::unique_ptr<AttributeQuadrics> combined_quadrics(const SurfaceMesh& mesh, const WedgeValues& all,
                                                     const SimplifySurfaceOptions& options);

/// Hoppe 1999: the difference from the linear function of the place that each component is over a triangle.
std::unique_ptr<AttributeQuadrics> gradient_quadrics(const SurfaceMesh& mesh, const WedgeValues& all,
                                                     const SimplifySurfaceOptions& options);

/// Whether they have any weight.
bool attributes_count(const SimplifySurfaceOptions& options);
/// The one asked for, or the default of the form, which depends on how long the result's edges will be.
double attribute_weight(const SurfaceMesh& mesh, const SimplifySurfaceOptions& options);

/// About the length of an edge of the result: the root of the mean area of its triangles; 0 where it is not known
/// how many are asked for.
double length_in_result(const SurfaceMesh& mesh, const SimplifySurfaceOptions& options);

/// So many mean areas are added to each triangle's own: by the area alone, thin parts made of small triangles
/// vanish for little. Measured on scans at 20 and 5 %: the largest distance is at most 1.9 times that of equal
/// weights (CGAL) with 0, 1.4 times with 1, 1.2 times with 2 and with 4; the RMS distance rises by 2 to 5 % with
/// each.
inline constexpr double kMeanAreas = 2;

/// The weight of a triangle's planes: its area and kMeanAreas mean ones, or 1.
double triangle_weight(const SurfaceMesh& mesh, std::int32_t h, bool area_weights);

}  // namespace tinsmith
