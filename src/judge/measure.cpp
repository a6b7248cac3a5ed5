#include "judge/measure.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "judge/colour_error.hpp"
#include "judge/coverage.hpp"
#include "judge/topology.hpp"
#include "tinsmith/error.hpp"

namespace tinsmith {
namespace {

/// A triangle's areas belong to the block of its first corner.
void measure_areas(const Block& block, const GridFrame& frame, Findings& findings) {
  const double orientation = frame.is_mirrored() ? -1 : 1;
  for (const Facet& facet : block.facets) {
    const auto& [a, b, c] = facet.position;
    if (!block.owns(a)) continue;
    const double doubled = orientation * doubled_area(a, b, c);
    if (!(doubled > 0)) ++findings.counts.folded;
    const double cells = std::abs(doubled) / 2;
    findings.cells_plan.add(cells);
    findings.area_plan.add(cells * cell_area(frame, (a.x + b.x + c.x) / 3, (a.y + b.y + c.y) / 3));
  }
}

void add(const Tin& tin, BlockedMesh& mesh) {
  mesh.add_vertices(tin.vertices);
  for (const auto& [a, b, c] : tin.triangles) mesh.add_triangle({a, b, c});
  mesh.close();
}

}  // namespace

std::vector<BlockNumber> blocks_to_measure(const BlockedMesh& mesh, const HeightField& field) {
  const std::vector<BlockNumber> of_mesh = mesh.blocks();
  const std::vector<BlockNumber> of_field = mesh.grid().blocks_with_samples(field);
  std::vector<BlockNumber> blocks;
  std::set_union(of_mesh.begin(), of_mesh.end(), of_field.begin(), of_field.end(), std::back_inserter(blocks));
  return blocks;
}

std::uint64_t memory_of(const BlockedMesh& mesh, BlockNumber block, const Samples& samples) {
  // Heights twice while they are read, errors and flags; facets, the uses of their edges, and what these connect.
  constexpr std::uint64_t kPerSample = 40;
  constexpr std::uint64_t kPerFacet = sizeof(Facet) + 80;
  // Levels of the field, differences and the heights again; what is read at a time.
  constexpr std::uint64_t kPerColour = 4 * (8 + 8 + 4) + 16;
  const bool has_colours = samples.colours != nullptr;
  return (kPerSample + (has_colours ? kPerColour : 0)) *
             static_cast<std::uint64_t>(mesh.grid().samples_of(block).area()) +
         (kPerFacet + (has_colours ? sizeof(FacetColours) : 0)) * mesh.n_facets(block);
}

void measure_block(BlockedMesh& mesh, BlockNumber number, const Samples& samples, Findings& findings) {
  const std::vector<Facet> facets = mesh.take(number);
  const Block block{mesh.grid(), mesh.grid().extent_of(number), facets};
  measure_areas(block, samples.frame, findings);
  measure_border(block, measure_topology(block, mesh.shared_parts(), findings), findings);
  measure_coverage(mesh.grid().samples_of(number), facets, samples.field, samples.frame, findings);
  if (samples.colours == nullptr) return;
  measure_colours(mesh.grid().samples_of(number), {facets, mesh.take_colours(number)}, samples, findings);
}

Certificate conclude(const BlockedMesh& mesh, Findings findings, const GridFrame& frame) {
  findings.largest_height = std::max(findings.largest_height, mesh.largest_height());
  Certificate certificate = certificate_of(findings, frame.metres_per_vertical_unit);
  certificate.components += mesh.shared_parts().count();
  certificate.vertices = mesh.n_vertices();
  certificate.triangles = mesh.n_triangles();
  return certificate;
}

void report_progress(const Samples& samples, double fraction) {
  if (samples.progress && !samples.progress(fraction, "verify")) throw Interrupted("verify: stopped on request");
}

Certificate measure(const Tin& tin, const Samples& samples, const Budget& budget) {
  const BlockGrid grid(samples.field, samples.block);
  BlockedMesh mesh(grid, samples.frame, budget);
  add(tin, mesh);
  const std::vector<BlockNumber> blocks = blocks_to_measure(mesh, samples.field);
  Findings findings;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    report_progress(samples, static_cast<double>(i) / static_cast<double>(blocks.size()));
    measure_block(mesh, blocks[i], samples, findings);
  }
  report_progress(samples, 1);
  return conclude(mesh, std::move(findings), samples.frame);
}

}  // namespace tinsmith
