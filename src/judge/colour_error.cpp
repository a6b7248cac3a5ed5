#include "judge/colour_error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "judge/facet_samples.hpp"

namespace tinsmith {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// Which channel of the field a channel of the mesh shows: grey is red, green and blue; alpha is the last.
std::size_t channel_of_field(std::size_t channel_of_mesh, std::size_t n_channels) {
  if (channel_of_mesh == 3) return n_channels - 1;
  return n_channels < 3 ? 0 : channel_of_mesh;
}

/// The largest differences at the samples of a block, by channel of the mesh; kNone: in no triangle.
struct Differences {
  GridRect rect;
  HeightGrid heights;
  ColourGrid colours;
  std::size_t n_channels;
  std::vector<double> largest;

  std::size_t index(std::int32_t x, std::int32_t y) const {
    return static_cast<std::size_t>(y - rect.y0) * static_cast<std::size_t>(rect.width) +
           static_cast<std::size_t>(x - rect.x0);
  }
  double level(std::size_t sample, std::size_t channel) const {
    return colours.channels[channel_of_field(channel, colours.channels.size())].z[sample];
  }
};

Differences read_samples(const GridRect& rect, const Samples& samples) {
  const std::size_t n_channels = n_mesh_channels(samples.colours->n_channels());
  return {rect, samples.field.read(rect), samples.colours->read(rect), n_channels,
          std::vector<double>(static_cast<std::size_t>(rect.area()) * n_channels, kNone)};
}

void compare(const Facet& facet, const FacetColours& colours, Differences& differences) {
  for_each_sample_in(
      facet, differences.rect, [&](std::int32_t x, std::int32_t y, const CornerWeights& corners, bool) {
        const std::size_t sample = differences.index(x, y);
        for (std::size_t c = 0; c < differences.n_channels; ++c) {
          const double level = corners.mean([&](std::size_t k) { return static_cast<double>(colours[k][c]); });
          const double difference = std::abs(level - differences.level(sample, c));
          double& largest = differences.largest[sample * differences.n_channels + c];
          if (!(difference <= largest)) largest = difference;  // also when there was none
        }
      });
}

}  // namespace

void measure_colours(const GridRect& rect, const ColouredFacets& mesh, const Samples& samples, Findings& findings) {
  Differences differences = read_samples(rect, samples);
  for (std::size_t i = 0; i < mesh.facets.size(); ++i) compare(mesh.facets[i], mesh.colours[i], differences);
  const std::size_t n = differences.n_channels;
  for (std::size_t sample = 0; sample < differences.heights.z.size(); ++sample) {
    const double* const largest = differences.largest.data() + sample * n;
    if (std::isnan(differences.heights.z[sample]) || std::isnan(largest[0])) continue;
    ++findings.counts.color_samples;
    for (std::size_t c = 0; c < n; ++c) findings.add_colour_difference(largest[c]);
  }
}

}  // namespace tinsmith
