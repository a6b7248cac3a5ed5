#pragma once
// What a vertex may do, as a table.

#include <array>
#include <cstdint>

namespace tinsmith {

enum class VertexKind : std::uint8_t {
  kInterior,  // closed star: goes anywhere
  kBorder,    // on a straight part of the outline: slides along it
  kCorner,    // where the outline turns: stays in plan, its height may change
  kLocked,    // known to another window, or a pinch: stays as it is
};

/// Where the vertex lies that replaces both ends of an edge (v0, v1).
enum class Freedom : std::uint8_t {
  kNever,     // the edge never collapses
  kAnywhere,  // in the kernel of the star
  kAlong,     // on the straight line of the border
  kAtFirst,   // where v0 is
  kAtSecond,  // where v1 is
};

/// kFreedom[kind of v0][kind of v1]. Between two vertices that are not interior the edge must be an edge of
/// the border, else the collapse would pinch the surface: the caller checks that.
inline constexpr std::array<std::array<Freedom, 4>, 4> kFreedom{{
    //               interior            border              corner              locked
    /* interior */ {{Freedom::kAnywhere, Freedom::kAtSecond, Freedom::kAtSecond, Freedom::kAtSecond}},
    /* border   */ {{Freedom::kAtFirst, Freedom::kAlong, Freedom::kAtSecond, Freedom::kAtSecond}},
    /* corner   */ {{Freedom::kAtFirst, Freedom::kAtFirst, Freedom::kNever, Freedom::kNever}},
    /* locked   */ {{Freedom::kAtFirst, Freedom::kAtFirst, Freedom::kNever, Freedom::kNever}},
}};

inline Freedom freedom(VertexKind k0, VertexKind k1) {
  return kFreedom[static_cast<std::size_t>(k0)][static_cast<std::size_t>(k1)];
}

}  // namespace tinsmith
