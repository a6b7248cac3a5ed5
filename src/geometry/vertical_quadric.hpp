#pragma once
// The vertical quadric of a vertex: the sum over its triangles of (area in plan) x (height of a point over the
// triangle's plane) squared. Garland and Heckbert 1997 with the vertical distance in place of the
// perpendicular one (no square root, and the order of collapses does not depend on the horizontal units),
// summed anew from the present triangles (the memoryless form of Lindstrom and Turk 1998). All planes pass
// through the vertex, so about that origin the quadric has no linear and no constant part: six numbers.

#include <algorithm>

namespace tinsmith {

/// E(p) = p^T [xx xy xz; xy yy yz; xz yz zz] p for p relative to the vertex; plan in cells.
struct VerticalQuadric {
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;

  /// Adds a plane of the slopes (dz/dx, dz/dy) with the weight of its area.
  void add(double slope_x, double slope_y, double area) {
    xx += area * slope_x * slope_x;
    xy += area * slope_x * slope_y;
    xz -= area * slope_x;
    yy += area * slope_y * slope_y;
    yz -= area * slope_y;
    zz += area;
  }
};

/// The error of an edge's new vertex as a function of its plan position alone, its height being the best for
/// that position: f(q) = q^T K q - 2 k^T q + c, with q relative to v0 and v1 at (dx, dy, dz).
struct PlanError {
  double kxx = 0, kxy = 0, kyy = 0;
  double kx = 0, ky = 0;
  double c = 0;
  double sxz = 0, syz = 0, szz = 0, rz = 0;

  PlanError(const VerticalQuadric& q0, const VerticalQuadric& q1, double dx, double dy, double dz) {
    const double rx = q1.xx * dx + q1.xy * dy + q1.xz * dz;
    const double ry = q1.xy * dx + q1.yy * dy + q1.yz * dz;
    rz = q1.xz * dx + q1.yz * dy + q1.zz * dz;
    sxz = q0.xz + q1.xz;
    syz = q0.yz + q1.yz;
    szz = q0.zz + q1.zz;
    const double inverse = 1 / szz;
    kxx = q0.xx + q1.xx - sxz * sxz * inverse;
    kxy = q0.xy + q1.xy - sxz * syz * inverse;
    kyy = q0.yy + q1.yy - syz * syz * inverse;
    kx = rx - sxz * rz * inverse;
    ky = ry - syz * rz * inverse;
    c = dx * rx + dy * ry + dz * rz - rz * rz * inverse;
  }

  /// Adds the error of a colour's channel over the same edge, with the level in place of the height, and free like
  /// it: Hoppe 1999 says the same with gradients.
  void add_channel(const PlanError& channel) {
    kxx += channel.kxx;
    kxy += channel.kxy;
    kyy += channel.kyy;
    kx += channel.kx;
    ky += channel.ky;
    c += channel.c;
  }

  double at(double x, double y) const {
    return std::max(0.0, x * (kxx * x + 2 * (kxy * y - kx)) + y * (kyy * y - 2 * ky) + c);
  }
  /// The best height at a plan position, relative to v0.
  double height(double x, double y) const { return (rz - sxz * x - syz * y) / szz; }
  /// The error when the height is given too.
  double at(double x, double y, double z) const {
    const double off = z - height(x, y);
    return at(x, y) + szz * off * off;
  }
};

}  // namespace tinsmith
