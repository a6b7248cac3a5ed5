#pragma once
// The vertical quadric of a vertex: the sum over its triangles of (area in plan) x (height of a point over the
// triangle's plane) squared. Garland and Heckbert 1997 with the vertical distance in place of the
// perpendicular one (no square root, and the order of collapses does not depend on the horizontal units),
// summed anew from the present triangles (the memoryless form of Lindstrom and Turk 1998). All planes pass
// through the vertex, so about that origin the quadric has no linear and no constant part: six numbers.

#include <algorithm>

namespace tinsmith {

/// E(p, z) = area (z - slope . p)^2 + p^T [xx xy; xy yy] p for a point relative to the vertex, plan in cells: the
/// mean plane and how the planes differ from it, so that nothing cancels.
struct VerticalQuadric {
  double slope_x = 0, slope_y = 0;
  double xx = 0, xy = 0, yy = 0;
  double area = 0;
};

/// Sums the planes of a quadric.
class VerticalSum {
 public:
  /// Adds a plane of the slopes (dz/dx, dz/dy) with the weight of its area.
  void add(double slope_x, double slope_y, double area) {
    const double x = area * slope_x;
    const double y = area * slope_y;
    xx_ += x * slope_x;
    xy_ += x * slope_y;
    yy_ += y * slope_y;
    x_ += x;
    y_ += y;
    area_ += area;
  }

  /// At least one plane has been added.
  VerticalQuadric quadric() const {
    const double slope_x = x_ / area_;
    const double slope_y = y_ / area_;
    return {
        slope_x, slope_y, std::max(0.0, xx_ - x_ * slope_x), xy_ - x_ * slope_y, std::max(0.0, yy_ - y_ * slope_y),
        area_};
  }

 private:
  double xx_ = 0, xy_ = 0, yy_ = 0;
  double x_ = 0, y_ = 0;
  double area_ = 0;
};

/// The error of an edge's new vertex as a function of its plan position alone, its height being the best for
/// that position: f(q) = q^T K q - 2 k^T q + c, with q relative to v0 and v1 at (dx, dy, dz). Over q the two mean
/// planes are apart by wx x + wy y + apart; the best height divides that as their areas say.
struct PlanError {
  double kxx = 0, kxy = 0, kyy = 0;
  double kx = 0, ky = 0;
  double c = 0;
  double slope_x = 0, slope_y = 0, z0 = 0;  // of the best height
  double szz = 0;

  PlanError(const VerticalQuadric& q0, const VerticalQuadric& q1, double dx, double dy, double dz) {
    const double wx = q0.slope_x - q1.slope_x;
    const double wy = q0.slope_y - q1.slope_y;
    const double apart = q1.slope_x * dx + q1.slope_y * dy - dz;
    szz = q0.area + q1.area;
    const double share1 = q1.area / szz;
    slope_x = q0.slope_x - share1 * wx;
    slope_y = q0.slope_y - share1 * wy;
    z0 = -share1 * apart;
    const double weight = q0.area * share1;
    kxx = q0.xx + q1.xx + weight * wx * wx;
    kxy = q0.xy + q1.xy + weight * wx * wy;
    kyy = q0.yy + q1.yy + weight * wy * wy;
    const double rx = q1.xx * dx + q1.xy * dy;
    const double ry = q1.xy * dx + q1.yy * dy;
    kx = rx - weight * wx * apart;
    ky = ry - weight * wy * apart;
    c = dx * rx + dy * ry + weight * apart * apart;
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
  double height(double x, double y) const { return z0 + slope_x * x + slope_y * y; }
  /// The error when the height is given too.
  double at(double x, double y, double z) const {
    const double off = z - height(x, y);
    return at(x, y) + szz * off * off;
  }
};

}  // namespace tinsmith
