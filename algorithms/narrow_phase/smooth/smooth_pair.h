// Part of smooth: the difference of two round cores, A - B, as a smooth support function with kinks
// at known normals. Includes core and kernels.
//
// A core is an image of a unit segment, cylinder, cone or ball: its axes are the columns of the
// posed matrix times the extents. With x, y, z the normal's products with the axes, the support
// function is
//   segment |z|,  cylinder |(x, y)| + |z|,  cone max(|(x, y)| - z, z),  ellipsoid |(x, y, z)|.
// It is smooth but where z = 0 (segment, cylinder) or 2 z = |(x, y)| (cone), where two ends tie, and
// along the axis, where all of a disc does. -B is such a core too, so the difference is the sum of
// two cores and a vector.
#pragma once

#include "algorithms/kernels/minkowski/support.h"

namespace touchstone {

// A symmetric matrix: the Hessian of a support function, which is zero along its normal.
struct Curvature {
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;

  void add(double weight, const Vec3d& v) {
    const Vec3d w = weight * v;
    xx += w.x() * v.x();
    xy += w.x() * v.y();
    xz += w.x() * v.z();
    yy += w.y() * v.y();
    yz += w.y() * v.z();
    zz += w.z() * v.z();
  }
  Vec3d operator*(const Vec3d& v) const {
    return {xx * v.x() + xy * v.y() + xz * v.z(), xy * v.x() + yy * v.y() + yz * v.z(),
            xz * v.x() + yz * v.y() + zz * v.z()};
  }
  double trace() const { return xx + yy + zz; }
  // The determinant across the normal.
  double minors() const { return (xx * yy - xy * xy) + (xx * zz - xz * xz) + (yy * zz - yz * yz); }
};

// What a core has furthest along a unit normal.
struct SmoothPoint {
  Vec3d point;         // relative to the core's centre
  double height;       // the normal's product with it
  double reach;        // of the disc or the ball: the norm above; 0 without one
  bool is_tip;         // cone: the tip, which has no disc
  Vec3d turn, turn_2;  // the curvature is that of these, over the reach; turn_2 only of a ball
};

class SmoothCore {
 public:
  // `mirrored`: the core of -B.
  SmoothCore(const PosedShape<double>& body, bool mirrored);

  bool is_ball() const { return core_ == SupportCore::ellipsoid; }
  bool is_cone() const { return core_ == SupportCore::cone; }
  bool has_disc() const { return core_ == SupportCore::cylinder || is_cone(); }
  // Two ends tie at normals n with n . axis() = tilt(), if has_tie().
  bool has_tie() const { return has_tie_; }
  const Vec3d& axis() const { return axis_; }
  double tilt() const { return tilt_; }
  const Vec3d& edge(int k) const { return edges_[k]; }
  // The greatest half axis of the disc or the ball.
  double radius() const { return radius_; }

  SmoothPoint furthest(const Vec3d& n) const;
  // Adds the curvature at that point, where the reach is longer by `more`.
  void add_curvature(const SmoothPoint& at, double more, double weight, Curvature& sum) const {
    if (at.is_tip || !(radius_ > 0) || !(at.reach + more > 0)) return;
    sum.add(weight / (at.reach + more), at.turn);
    if (is_ball()) sum.add(weight / (at.reach + more), at.turn_2);
  }
  // The angle between n and the normals of the tie, about, and 0 if there is none: use has_tie().
  double angle_to_tie(const Vec3d& n) const { return n.dot(axis_) - tilt_; }

 private:
  SupportCore core_;
  Vec3d edges_[3];
  Vec3d axis_ = Vec3d::UnitZ();
  double tilt_ = 0, radius_ = 0;
  bool has_tie_ = false;
};

struct SmoothPair {
  explicit SmoothPair(SupportPair<double>& pair)
      : a(pair.a(), false), b(pair.b(), true), offset(-pair.centre_b()) {}

  SmoothCore a, b;  // b is that of -B
  Vec3d offset;     // of its centre

  // The height of the difference along n: the overlap of the cores, if positive.
  double height(const Vec3d& n) const;
};

// Returns true if the matrix is a rotation times the extents' scale, up to 1e-12.
bool is_rotation(const Mat3d& m);

}  // namespace touchstone
