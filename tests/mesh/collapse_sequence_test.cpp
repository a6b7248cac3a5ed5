// Random sequences of legal collapses, with a link condition and a half-space test of their own.

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <random>
#include <set>

#include "support/mesh_drawings.hpp"

namespace tinsmith {
namespace {

using namespace test;

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

std::set<std::int32_t> neighbours(const WindowMesh& mesh, std::int32_t v) {
  std::set<std::int32_t> found;
  for_each_out(mesh, v, [&](std::int32_t h) {
    found.insert(mesh.destination(h));
    found.insert(mesh.origin[at(WindowMesh::previous(h))]);
  });
  return found;
}

bool is_linked(const WindowMesh& mesh, std::int32_t h) {
  const std::set<std::int32_t> a = neighbours(mesh, mesh.origin[at(h)]);
  const std::set<std::int32_t> b = neighbours(mesh, mesh.destination(h));
  const auto n_common = std::count_if(a.begin(), a.end(), [&](std::int32_t v) { return b.contains(v); });
  return n_common == (mesh.is_border_edge(h) ? 1 : 2);
}

// Every triangle of both ends but the edge's own stays counter-clockwise when its end goes to p.
bool stays_unfolded(const WindowMesh& mesh, std::int32_t h, LatticePoint p) {
  const std::int32_t v0 = mesh.origin[at(h)];
  const std::int32_t v1 = mesh.destination(h);
  bool good = true;
  int n_left = 0;
  for (const std::int32_t v : {v0, v1}) {
    for_each_out(mesh, v, [&](std::int32_t g) {
      const std::int32_t a = mesh.destination(g);
      const std::int32_t b = mesh.origin[at(WindowMesh::previous(g))];
      if (a == v0 || a == v1 || b == v0 || b == v1) return;
      ++n_left;
      good = good && orient(p, mesh.position[at(a)], mesh.position[at(b)]) > 0;
    });
  }
  return good && n_left > 0;
}

// An apex with no other triangle would be left alone.
bool keeps_apexes(const WindowMesh& mesh, std::int32_t h) {
  const auto apex_fan = [&](std::int32_t e) { return fan_size(mesh, mesh.origin[at(WindowMesh::previous(e))]); };
  return apex_fan(h) > 1 && (mesh.is_border_edge(h) || apex_fan(mesh.twin[at(h)]) > 1);
}

// Of the frame of a grid of columns x rows samples: how many of its lines a place lies on.
int n_frame_lines(LatticePoint p, std::int32_t columns, std::int32_t rows) {
  return (p.x == 0 || p.x == (columns - 1) * kLatticePerCell) + (p.y == 0 || p.y == (rows - 1) * kLatticePerCell);
}

struct Counts {
  int interior = 0;  // both ends inside, somewhere between them
  int onto_border = 0;
  int along_border = 0;
  int valence_three = 0;
};

class Sequence {
 public:
  Sequence(std::uint64_t seed, std::int32_t columns, std::int32_t rows)
      : random_(seed), columns_(columns), rows_(rows), mesh_(grid_mesh(columns, rows)) {}

  void run(int n_tries, Counts& counts) {
    const std::int64_t area2 = area2_of(mesh_);
    for (int i = 0; i < n_tries; ++i) {
      const auto h = static_cast<std::int32_t>(random_() % mesh_.origin.size());
      if (mesh_.origin[at(h)] == kNone || !try_collapse(h, counts)) continue;
      ASSERT_EQ(validate(mesh_), "");
      ASSERT_EQ(euler_number(mesh_), 1);
      ASSERT_EQ(area2_of(mesh_), area2);
    }
  }

 private:
  bool try_collapse(std::int32_t h, Counts& counts) {
    const std::int32_t v0 = mesh_.origin[at(h)];
    const std::int32_t v1 = mesh_.destination(h);
    const std::optional<LatticePoint> p = place(h, v0, v1);
    if (!p || !is_linked(mesh_, h) || !keeps_apexes(mesh_, h) || !stays_unfolded(mesh_, h, *p)) return false;
    const bool is_border0 = mesh_.is_border_vertex(v0);
    const bool is_border1 = mesh_.is_border_vertex(v1);
    ++(is_border0 && is_border1   ? counts.along_border
       : is_border0 || is_border1 ? counts.onto_border
                                  : counts.interior);
    if (std::min(fan_size(mesh_, v0), fan_size(mesh_, v1)) == 3) ++counts.valence_three;
    const std::int32_t kept = is_border0 == is_border1 ? (random_() % 2 == 0 ? v0 : v1) : is_border0 ? v0 : v1;
    collapse_edge(mesh_, h, kept, {*p, 1});
    return true;
  }

  // Where the new vertex keeps the outline.
  std::optional<LatticePoint> place(std::int32_t h, std::int32_t v0, std::int32_t v1) {
    const LatticePoint p0 = mesh_.position[at(v0)];
    const LatticePoint p1 = mesh_.position[at(v1)];
    const int lines0 = n_frame_lines(p0, columns_, rows_);
    const int lines1 = n_frame_lines(p1, columns_, rows_);
    if (lines0 > 0 && lines1 > 0 && (!mesh_.is_border_edge(h) || (lines0 == 2 && lines1 == 2))) return {};
    if (lines0 != lines1) return lines0 > lines1 ? p0 : p1;
    return LatticePoint{(p0.x + p1.x) / 2, (p0.y + p1.y) / 2};
  }

  std::mt19937_64 random_;
  std::int32_t columns_;
  std::int32_t rows_;
  WindowMesh mesh_;
};

TEST(CollapseEdge, RandomSequencesKeepInvariantsEulerNumberAndArea) {
  Counts counts;
  for (std::uint64_t seed = 31; seed < 71; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const auto side = static_cast<std::int32_t>(2 + seed % 9);
    Sequence(seed, side + 3, side).run(1500, counts);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(counts.interior, 100);
  EXPECT_GT(counts.onto_border, 100);
  EXPECT_GT(counts.along_border, 100);
  EXPECT_GT(counts.valence_three, 30);
}

}  // namespace
}  // namespace tinsmith
