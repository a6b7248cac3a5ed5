// Time of the stages inside one window, one by one: select, triangulate (CDT), simplify. run.sh builds it as
// micro_bench in its build folder.

#include <benchmark/benchmark.h>

#include "mesh/window_mesh.hpp"
#include "simplify/simplify.hpp"
#include "stitch/kinds.hpp"
#include "terrain.hpp"
#include "triangulate/select.hpp"
#include "triangulate/triangulate.hpp"

namespace {

using namespace tinsmith;

constexpr std::int32_t kSide = 257;
constexpr GridRect kWindow{1344, 1088, kSide, kSide};  // of middling roughness

/// Generated mountains under the window and one sample around it.
const HeightGrid& mountains() {
  static const HeightGrid grid = [] {
    Terrain terrain;
    terrain.width = terrain.height = 2049;
    return heights_of(terrain, {kWindow.x0 - 1, kWindow.y0 - 1, kSide + 2, kSide + 2});
  }();
  return grid;
}

/// Centimetres of tolerance, at which some 50, 20, 5 and 1 % of the samples are kept as vertices.
void tolerances(benchmark::internal::Benchmark* one) {
  for (const int centimetres : {11, 54, 190, 530}) one->Arg(centimetres);
  one->Unit(benchmark::kMillisecond);
}

double tolerance_of(const benchmark::State& state) { return static_cast<double>(state.range(0)) / 100; }

void count_samples(benchmark::State& state) { state.SetItemsProcessed(state.iterations() * kWindow.area()); }

void select(benchmark::State& state) {
  for ([[maybe_unused]] auto _ : state) {
    Selection selection{kWindow, std::vector<std::uint8_t>(static_cast<std::size_t>(kWindow.area()))};
    select_samples(mountains(), tolerance_of(state), selection);
    benchmark::DoNotOptimize(selection.is_selected.data());
  }
  count_samples(state);
}
BENCHMARK(select)->Apply(tolerances);

void triangulate_window(benchmark::State& state) {
  for ([[maybe_unused]] auto _ : state)
    benchmark::DoNotOptimize(triangulate(mountains(), kWindow, {tolerance_of(state), 1}));
  count_samples(state);
}
BENCHMARK(triangulate_window)->Apply(tolerances);

void simplify_window(benchmark::State& state) {
  WindowMesh start = triangulate(mountains(), kWindow, {tolerance_of(state), 1});
  set_kinds(start, mountains());
  SimplifyOptions options;
  options.tolerance = tolerance_of(state);
  std::uint64_t n_collapses = 0;
  for ([[maybe_unused]] auto _ : state) {
    WindowMesh mesh = start;
    n_collapses = simplify(mesh, mountains(), options).collapses;
  }
  count_samples(state);
  state.counters["collapses"] = static_cast<double>(n_collapses);
}
BENCHMARK(simplify_window)->Apply(tolerances);

}  // namespace
