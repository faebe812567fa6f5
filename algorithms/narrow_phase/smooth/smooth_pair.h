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

#include <algorithm>
#include <cmath>

#include "algorithms/kernels/minkowski/support.h"
#include "algorithms/narrow_phase/smooth/curvature.h"

namespace touchstone {

// What a core has furthest along a unit normal.
struct SmoothPoint {
  Vec3d point = Vec3d::Zero();  // relative to the core's centre
  double height = 0;            // the normal's product with it
  double reach = 0;             // of the disc or the ball: the norm above; 0 without one
  bool is_tip = false;          // cone: the tip, which has no disc
  // The curvature is the squares of these over the reach; turn_2 is of a ball only.
  Vec3d turn = Vec3d::Zero(), turn_2 = Vec3d::Zero();
};

class SmoothCore {
 public:
  // The body's matrix is a rotation up to 1e-12. `unit`: that of the pair, metres. `mirrored`: the
  // core of -B.
  SmoothCore(const PosedShape<double>& body, double unit, bool mirrored);

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
  // The same point's height alone.
  double height(const Vec3d& n) const;
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

inline SmoothPoint SmoothCore::furthest(const Vec3d& n) const {
  // Reaches below this have a direction of rounding only; lengths are at most about 1.
  constexpr double least_reach = 1e-140;
  SmoothPoint found;
  if (core_ == SupportCore::point) return found;
  const double x = edges_[0].dot(n), y = edges_[1].dot(n), z = edges_[2].dot(n);
  if (core_ == SupportCore::segment) {
    found.point = z < 0 ? Vec3d(-edges_[2]) : edges_[2];
    found.height = std::abs(z);
    return found;
  }
  if (is_ball()) {
    found.reach = found.height = std::sqrt(x * x + y * y + z * z);
    if (!(found.reach > least_reach)) return found;
    const Vec3d w = Vec3d(x, y, z) / found.reach;
    found.point = w.x() * edges_[0] + w.y() * edges_[1] + w.z() * edges_[2];
    // Two unit vectors across w.
    const double sign = std::copysign(1.0, w.z()), t = -1 / (sign + w.z()), s = w.x() * w.y() * t;
    const Vec3d u(1 + sign * w.x() * w.x() * t, sign * s, -sign * w.x());
    const Vec3d v(s, sign + w.y() * w.y() * t, -w.y());
    found.turn = u.x() * edges_[0] + u.y() * edges_[1] + u.z() * edges_[2];
    found.turn_2 = v.x() * edges_[0] + v.y() * edges_[1] + v.z() * edges_[2];
    return found;
  }
  found.reach = std::sqrt(x * x + y * y);
  found.is_tip = is_cone() && 2 * z > found.reach;
  if (found.is_tip) {
    found.point = edges_[2];
    found.height = z;
    return found;
  }
  const bool down = is_cone() || z < 0;
  found.height = found.reach + (down ? -z : z);
  found.point = down ? Vec3d(-edges_[2]) : edges_[2];
  if (!(found.reach > least_reach)) return found;
  const double along = x / found.reach, across = y / found.reach;
  found.point += along * edges_[0] + across * edges_[1];
  found.turn = along * edges_[1] - across * edges_[0];
  return found;
}

inline double SmoothCore::height(const Vec3d& n) const {
  if (core_ == SupportCore::point) return 0;
  const double x = edges_[0].dot(n), y = edges_[1].dot(n), z = edges_[2].dot(n);
  const double flat = x * x + y * y;
  switch (core_) {
    case SupportCore::segment: return std::abs(z);
    case SupportCore::cylinder: return std::sqrt(flat) + std::abs(z);
    case SupportCore::cone: return std::max(std::sqrt(flat) - z, z);
    default: return std::sqrt(flat + z * z);
  }
}

struct SmoothPair {
  explicit SmoothPair(SupportPair<double>& pair)
      : a(pair.a(), pair.unit(), false), b(pair.b(), pair.unit(), true), offset(-pair.centre_b()) {}

  SmoothCore a, b;  // b is that of -B
  Vec3d offset;     // of its centre

  // The height of the difference along n: the overlap of the cores, if positive.
  double height(const Vec3d& n) const { return a.height(n) + b.height(n) + n.dot(offset); }
};

// Returns true if the matrix is a rotation times the extents' scale, up to 1e-12.
bool is_rotation(const Mat3d& m);

}  // namespace touchstone
