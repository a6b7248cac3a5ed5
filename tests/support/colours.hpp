#pragma once
// Colours drawn by rule, and how far a mesh is from them.

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "mesh/window_mesh.hpp"
#include "samples/colour_grid.hpp"
#include "support/surface_check.hpp"

namespace tinsmith::test {

/// Colours from f(column, row).
template <class F>
ColourGrid colours_of(const GridRect& rect, std::size_t n_channels, F&& f) {
  ColourGrid grid{rect, std::vector<HeightGrid>(n_channels, HeightGrid{rect, {}})};
  for (std::int32_t y = rect.y0; y < rect.y0 + rect.height; ++y) {
    for (std::int32_t x = rect.x0; x < rect.x0 + rect.width; ++x) {
      const Levels colour = f(x, y);
      for (std::size_t c = 0; c < n_channels; ++c) grid.channels[c].z.push_back(static_cast<double>(colour[c]));
    }
  }
  return grid;
}

/// Squares of 12 x 12 samples, black and orange.
inline Levels checker(std::int32_t x, std::int32_t y) {
  return (x / 12 + y / 12) % 2 == 0 ? Levels{0, 0, 0, 0} : Levels{240, 120, 20, 0};
}

/// Noise without any order.
inline Levels noise(std::int32_t x, std::int32_t y) {
  const auto hash = static_cast<std::uint32_t>(x * 73856093) ^ static_cast<std::uint32_t>(y * 19349663);
  const auto level = [&](std::uint32_t salt) { return static_cast<float>((hash * salt >> 16U) % 256U); };
  return {level(2654435761U), level(2246822519U), level(3266489917U), 0};
}

/// Gives the vertices, which lie on samples, the colours there.
inline void paint(WindowMesh& mesh, const ColourGrid& colours) {
  mesh.colour.clear();
  for (const LatticePoint p : mesh.position)
    mesh.colour.push_back(colours.at(p.x / kLatticePerCell, p.y / kLatticePerCell));
}

/// Root mean square over the samples in or on triangles and the channels, by brute force.
inline double colour_rmse(const Soup& soup, const std::vector<Levels>& vertex_colour, const ColourGrid& colours) {
  double sum = 0;
  double n = 0;
  for (const auto& [a, b, c] : soup.triangles) {
    const LatticePoint pa = soup.position[a];
    const LatticePoint pb = soup.position[b];
    const LatticePoint pc = soup.position[c];
    const auto area = static_cast<double>(detail::edge_test(pa, pb, pc));
    for (std::int32_t y = std::min({pa.y, pb.y, pc.y}) / 16; y <= std::max({pa.y, pb.y, pc.y}) / 16; ++y) {
      for (std::int32_t x = std::min({pa.x, pb.x, pc.x}) / 16; x <= std::max({pa.x, pb.x, pc.x}) / 16; ++x) {
        const LatticePoint s{x * 16, y * 16};
        const double wa = static_cast<double>(detail::edge_test(pb, pc, s)) / area;
        const double wb = static_cast<double>(detail::edge_test(pc, pa, s)) / area;
        const double wc = static_cast<double>(detail::edge_test(pa, pb, s)) / area;
        if (wa < 0 || wb < 0 || wc < 0) continue;
        for (std::size_t i = 0; i < colours.channels.size(); ++i) {
          const auto level = [&](std::size_t v) { return static_cast<double>(vertex_colour[v][i]); };
          const double off = wa * level(a) + wb * level(b) + wc * level(c) - colours.channels[i].at(x, y);
          sum += off * off;
          ++n;
        }
      }
    }
  }
  return std::sqrt(sum / n);
}

}  // namespace tinsmith::test
