#pragma once
// The colours of the samples under a star, and the colour of its middle that fits them best.

#include <cstdint>
#include <vector>

#include "mesh/window_mesh.hpp"
#include "samples/colour_grid.hpp"

namespace tinsmith {

/// How colour weighs in a simplification.
struct ColourOptions {
  // Levels of 255. No collapse leaves the samples of its star farther off than this, as root mean square over the
  // channels and the star's area; and so much of it weighs like the whole tolerance of the heights.
  double tolerance = 12;
  double weight = 1;  // of squared colour errors beside squared vertical ones
};

/// The side of a star's triangle opposite to its middle, with the colours of its ends; counter-clockwise.
struct ColourSide {
  LatticePoint a;
  LatticePoint b;
  Levels colour_a{};
  Levels colour_b{};
};
using ColourStar = std::vector<ColourSide>;

/// The sums over the samples of a star that give the squared error of any colour of its middle. With the weight w
/// of the middle at a sample, and the residual r of the sample over what the other corners bear there: sum of (r -
/// w colour)^2.
struct ColourFit {
  std::size_t n_channels = 0;
  double sum_ww = 0;
  std::array<double, kMaxChannels> sum_wr{};
  std::array<double, kMaxChannels> sum_rr{};

  /// The least-squares colour within 0 to 255; `otherwise` where no sample depends on it.
  Levels best(const Levels& otherwise) const;
  /// In squared levels, summed over samples and channels.
  double squared_error(const Levels& colour) const;
};

/// Adds the sides of the triangles of v that do not have the vertex `other` (kNone: of all).
void add_colour_sides(const WindowMesh& mesh, std::int32_t v, std::int32_t other, ColourStar& star);

/// Of a middle at p, which is strictly inside every side of the star; `samples` holds all colours under it.
ColourFit fit_colour(const ColourStar& star, const ColourGrid& samples, LatticePoint p);

/// The same to the bit, with the instructions that every machine has.
ColourFit fit_colour_portable(const ColourStar& star, const ColourGrid& samples, LatticePoint p);

/// Of the star in plan, in cells.
double area_of(const ColourStar& star, LatticePoint p);

}  // namespace tinsmith
