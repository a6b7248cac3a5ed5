#include "pipeline/workload.hpp"

#include <algorithm>

namespace tinsmith {

namespace {

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

}  // namespace

Workload::Workload(const HeightField& field, const WindowGraph& graph) {
  for (int r = 0; r < graph.n_rounds(); ++r) {
    std::vector<std::uint8_t>& has_samples = has_samples_[at(r)];
    has_samples.resize(at(graph.windows(r).count()), 0);
    for (std::int64_t w = 0; w < graph.windows(r).count(); ++w) {
      if (r == 0) {
        has_samples[at(w)] = field.is_surely_void(graph.samples({r, w})) ? 0 : 1;
      } else {
        graph.inputs({r, w}).for_each([&](std::int64_t maker) {
          if (!is_void({r - 1, maker})) has_samples[at(w)] = 1;
        });
      }
    }
    n_all_[at(r)] = std::count(has_samples.begin(), has_samples.end(), 1);
  }
}

void Workload::add_done(WindowName task) {
  if (!is_void(task)) ++n_done_[at(task.round)];
}

double Workload::fraction() const {
  double done = 0;
  double all = 0;
  for (std::size_t r = 0; r < kRoundShare.size(); ++r) {
    if (n_all_[r] == 0) continue;
    done += kRoundShare[r] * (static_cast<double>(n_done_[r]) / static_cast<double>(n_all_[r]));
    all += kRoundShare[r];
  }
  return all > 0 ? done / all : 1;
}

}  // namespace tinsmith
