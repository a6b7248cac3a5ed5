#pragma once
// Colours and normals in the collapse: a quadric of their own for each wedge, eq. 25-28 of the paper.

#include <array>
#include <cstdint>
#include <vector>

#include "geometry/quadric.hpp"
#include "simplify/surface_mesh.hpp"

namespace tinsmith {

/// One attribute with three components at every wedge, and its quadrics.
struct AttributeField {
  AttributeKind kind = AttributeKind::kColour;
  std::vector<Vec<3>> value;        // by wedge
  std::vector<Quadric<3>> quadric;  // by wedge
};

/// A number at every wedge that goes along with the collapse and costs nothing.
struct ScalarField {
  std::string name;
  std::vector<double> value;  // by wedge
};

/// The attributes of a surface under simplification.
struct SurfaceAttributes {
  std::vector<AttributeField> fields;
  std::vector<ScalarField> scalars;
};

/// Values of the wedges' original vertices, and quadrics summed over their triangles (weights: see
/// `triangle_weight`).
SurfaceAttributes attributes_of(const SurfaceMesh& mesh, const Surface& surface, bool area_weights);

/// The weight of a triangle's planes: its area, or 1.
double triangle_weight(const SurfaceMesh& mesh, std::int32_t h, bool area_weights);

/// The best value of an attribute for a collapsed pair of wedges: the minimum of their quadric, drawn a little to
/// the value `between` them, which decides where the quadric leaves it open; in the attribute's range.
Vec<3> best_value(const Quadric<3>& quadric, const Vec<3>& between, AttributeKind kind);

}  // namespace tinsmith
