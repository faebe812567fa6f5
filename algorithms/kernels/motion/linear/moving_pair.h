// Used by gjk-ray-cast and mpr-ray-cast: two bodies whose rotations are fixed, as the difference A - B of their cores
// and a point that moves past it.
#pragma once

#include <limits>

#include "algorithms/core/motion.h"
#include "algorithms/kernels/minkowski/simplex.h"

namespace touchstone {

// World axes; lengths are divided by `unit`, which is above the bodies' sizes, their offset at any
// time and the displacement. At time t body b's centre is at start + t * velocity from body a's; the
// bodies share a point where that is in the difference of the bodies about their own centres.
class MovingPair {
 public:
  // How far the computed gap of a plane is off the true one. With u half of epsilon, as proven in
  // certified/proven_rounding.h, where the unit is above offset and sizes too:
  //   support points, direction, its length, radii              248 u
  //   velocity (u), its product with t (u), the sum (u)           5.2 u along a direction
  //   normal . velocity and its product with 1 - t, the sum       11 u
  //   t itself, advanced by gap / speed, times the speed           8 u
  // in all 273 u.
  static constexpr double rounding = 144 * std::numeric_limits<double>::epsilon();

  // The reach is that of both bodies (metres): the sum of the radii of balls about their centres.
  MovingPair(const CentreOffset& offset, const Vec3d& displacement, double reach,
             const SupportShape<double>& a, const Mat3d& rotation_a, const SupportShape<double>& b,
             const Mat3d& rotation_b);

  // False if lengths are beyond the range of the proof.
  bool is_in_range() const { return unit_ < 0x1p959; }

  // A good direction to search for a first plane along.
  Vec3d first_direction() const;

  // The point of the difference furthest in a direction. `a` and `b` are relative to the bodies' own
  // centres; `difference` is relative to b's offset at the time.
  template <class CoreOfA = GenericCore, class CoreOfB = GenericCore>
  DifferencePoint<double> support(const Vec3d& direction) {
    DifferencePoint<double> point;
    point.a = furthest<CoreOfA>(a_, direction);
    point.b = furthest<CoreOfB>(b_, -direction);
    point.difference = point.a - (point.b + offset_);
    return point;
  }

  Vec3d corner_of_a(std::uint32_t corner) const { return a_.corner(corner); }
  // The point of the difference of two corners.
  DifferencePoint<double> of_corners(const CornerPair& corners) const {
    DifferencePoint<double> point;
    point.a = a_.corner(corners.a);
    point.b = b_.corner(corners.b);
    point.difference = point.a - (point.b + offset_);
    return point;
  }

  // Sets the time, and moves the differences of a simplex there.
  void move_to(double time, Simplex<double>& simplex);

  const SupportShape<double>& shape_a() const { return a_.shape(); }
  const SupportShape<double>& shape_b() const { return b_.shape(); }
  // The bodies' rotations, times their shapes' units over the pair's.
  const Mat3d& matrix_a() const { return a_.matrix(); }
  const Mat3d& matrix_b() const { return b_.matrix(); }
  double time() const { return time_; }
  const Vec3d& start() const { return start_; }
  const Vec3d& offset() const { return offset_; }
  const Vec3d& velocity() const { return velocity_; }
  double radius() const { return a_.radius() + b_.radius(); }
  double unit() const { return unit_; }
  double reach() const { return reach_; }  // of the difference, from its centre
  // The radius of a ball about -offset() that the difference of the cores holds, or 0.
  double inner_radius() const { return inner_radius_; }
  void set_inner_radius(double metres) { inner_radius_ = metres / unit_; }
  // Where the balls around two points of the cores meet, relative to a's centre. The line between the points
  // has no use for a normal, which is off by the root of the tolerance.
  Vec3d between_balls(const DifferencePoint<double>& point) const {
    return radius() > 0 ? Vec3d(point.a - a_.radius() / radius() * point.difference) : point.a;
  }

 private:
  // The vertices of a hull that has just been scanned are near.
  template <class Core>
  static Vec3d furthest(PosedShape<double>& posed, const Vec3d& direction) {
    const SupportShape<double>& shape = posed.shape();
    if (Core::of(shape) != SupportCore::hull || !shape.cells.empty()) {
      return posed.support<Core>(direction);
    }
    return posed.matrix() *
           shape.scanned_vertex(shape.furthest(posed.matrix().transpose() * direction));
  }

  double unit_;  // metres, a power of two
  double reach_;
  PosedShape<double> a_, b_;
  Vec3d start_, velocity_, offset_;
  double time_ = 0, inner_radius_ = 0;
};

}  // namespace touchstone
