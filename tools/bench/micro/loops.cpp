// Time of the loops that a profile of simplify shows: the sweep over the samples of a star's triangle, the
// placement of an edge, the queue, the collapse as topology.

#include <benchmark/benchmark.h>

#include <cmath>

#include "mesh/window_mesh.hpp"
#include "simplify/bucket_queue.hpp"
#include "simplify/placement.hpp"
#include "simplify/star.hpp"
#include "terrain.hpp"

namespace {

using namespace tinsmith;

constexpr std::int32_t kSide = 257;

/// Sweeps one triangle with legs of the given number of cells.
void sample_sweep(benchmark::State& state) {
  const HeightGrid samples = heights_of(Terrain{}, {0, 0, kSide, kSide});
  const auto leg = static_cast<std::int32_t>(state.range(0)) * kLatticePerCell;
  const LatticePoint p{100 * kLatticePerCell + 3, 100 * kLatticePerCell + 5};
  const Side side{{{p.x + leg, p.y}, samples.at(100, 100)}, {{p.x, p.y + leg}, samples.at(100, 100)}};
  const Star star{side};
  const Bound bound{samples, 1e6, samples.at(100, 100)};  // a tolerance that never stops the sweep early
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(feasible_heights(star, bound, p));
  state.SetItemsProcessed(state.iterations() * state.range(0) * state.range(0) / 2);
}
BENCHMARK(sample_sweep)->Arg(2)->Arg(5)->Arg(20)->Arg(100);

/// An edge between two vertices of a rough surface.
struct RoughEdge {
  VerticalQuadric quadric0;
  VerticalQuadric quadric1;

  RoughEdge() {
    VerticalSum sum0;
    VerticalSum sum1;
    for (int i = 0; i < 6; ++i) {
      sum0.add(0.3 * std::cos(i), 0.2 * std::sin(i), 4);
      sum1.add(0.2 * std::sin(i), 0.4 * std::cos(i), 3);
    }
    quadric0 = sum0.quadric();
    quadric1 = sum1.quadric();
  }
  Edge edge() const {
    return {{{160, 160}, 10, VertexKind::kInterior, quadric0}, {{192, 176}, 11, VertexKind::kInterior, quadric1}};
  }
};

void placement_cost(benchmark::State& state) {
  const RoughEdge rough;
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(edge_cost(rough.edge(), {}));
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(placement_cost);

void placement_candidates(benchmark::State& state) {
  const RoughEdge rough;
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(place(rough.edge(), {}));
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(placement_candidates);

/// Pushes three times as many entries as a window has vertices, and pops them all.
void queue(benchmark::State& state) {
  constexpr int kEntries = 3 * kSide * kSide;
  for ([[maybe_unused]] auto _ : state) {
    BucketQueue queue(kEntries);
    for (std::int32_t i = 0; i < kEntries; ++i)
      queue.push(BucketQueue::class_of(static_cast<float>(i * 7919LL % kEntries)), i);
    std::int32_t vertex = 0;
    std::size_t cost_class = 0;
    while (queue.pop(vertex, cost_class)) benchmark::DoNotOptimize(vertex);
  }
  state.SetItemsProcessed(state.iterations() * kEntries);
}
BENCHMARK(queue)->Unit(benchmark::kMillisecond);

/// The full grid of a window.
WindowMesh full_window() {
  WindowMesh mesh;
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (std::int32_t y = 0; y < kSide; ++y) {
    for (std::int32_t x = 0; x < kSide; ++x) {
      mesh.position.push_back({x * kLatticePerCell, y * kLatticePerCell});
      if (x + 1 == kSide || y + 1 == kSide) continue;
      const std::int32_t v = y * kSide + x;
      triangles.push_back({v, v + 1, v + kSide});
      triangles.push_back({v + 1, v + kSide + 1, v + kSide});
    }
  }
  mesh.height.resize(mesh.position.size());
  mesh.kind.resize(mesh.position.size(), VertexKind::kInterior);
  mesh.is_settled.resize(mesh.position.size());
  connect(mesh, triangles);
  return mesh;
}

/// Collapses the edges from every vertex of odd column and row inside the window to its right neighbour.
void collapse(benchmark::State& state) {
  const WindowMesh start = full_window();
  for ([[maybe_unused]] auto _ : state) {
    state.PauseTiming();
    WindowMesh mesh = start;
    state.ResumeTiming();
    for (std::int32_t y = 1; y < kSide - 1; y += 2) {
      for (std::int32_t x = 1; x < kSide - 2; x += 2) {
        const std::int32_t right = y * kSide + x + 1;
        const auto place = static_cast<std::size_t>(right);
        std::int32_t h = mesh.out[place - 1];
        while (mesh.destination(h) != right) h = mesh.turn(h);
        collapse_edge(mesh, h, right, {mesh.position[place], 0});
      }
    }
  }
  state.SetItemsProcessed(state.iterations() * (kSide / 2) * ((kSide - 2) / 2));
}
BENCHMARK(collapse)->Unit(benchmark::kMillisecond);

}  // namespace
