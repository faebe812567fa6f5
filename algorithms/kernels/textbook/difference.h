// The Minkowski difference C = A - B of two bounded bodies, straight from their shapes. Used by gjk-textbook,
// gjk-signed-volumes, epa-textbook, mpr-textbook and sat-textbook.
//
// The frame has the world's axes and the origin of body a. Lengths are divided by a power of two above the extent of the
// pair, so that no threshold depends on the scale or on the place in the world.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "algorithms/core/body_pairs.h"
#include "algorithms/core/bounds.h"
#include "algorithms/core/outcome.h"
#include "algorithms/core/pose.h"
#include "algorithms/core/shape.h"

namespace touchstone::textbook {

// A support point w = a - b of C, with the points of the bodies that it is made of.
struct SupportPoint {
  Vec3d w, a, b;
};

// What a query needs of a shape, metres in body coordinates.
struct BoundShape {
  const Shape* shape;
  double reach;  // greatest distance of a point from the body's origin
  double size;   // the longest side of a box around it, or less
};

inline std::vector<BoundShape> bind_shapes(std::span<const Shape> shapes) {
  std::vector<BoundShape> bound;
  for (const Shape& s : shapes) {
    Vec3d low = s.half_extents, high = -low;
    if (s.kind == ShapeKind::hull) low = high = s.hull->vertices[0];
    for (std::size_t k = 0; s.kind == ShapeKind::hull && k < s.hull->vertices.size(); ++k) {
      low = low.cwiseMin(s.hull->vertices[k]);
      high = high.cwiseMax(s.hull->vertices[k]);
    }
    const double reach = loose_reach(s, Mat3d::Identity());
    const bool is_flat_sided = s.kind == ShapeKind::box || s.kind == ShapeKind::hull;
    bound.push_back({&s, reach, is_flat_sided ? (high - low).cwiseAbs().maxCoeff() : 1.4 * reach});
  }
  return bound;
}

class Difference {
 public:
  // Refers to the poses.
  Difference(const BoundShape& a, const Pose& pose_a, const BoundShape& b, const Pose& pose_b)
      : a_(*a.shape), b_(*b.shape), origin_(pose_a.translation) {
    offset_ = pose_b.translation - pose_a.translation;
    rotation_a_ = {pose_a.rotation, Vec3d::Zero()};
    rotation_b_ = {pose_b.rotation, Vec3d::Zero()};
    const double extent =
        a.reach * stretch(pose_a) + b.reach * stretch(pose_b) + offset_.stableNorm();
    is_finite_ = extent < std::numeric_limits<double>::max() / 4;
    int exponent = 0;
    std::frexp(is_finite_ ? std::max(extent, std::numeric_limits<double>::min()) : 1, &exponent);
    unit_ = std::ldexp(1.0, exponent);
    rounding_ = 6 * std::numeric_limits<double>::epsilon() * (extent / unit_) +
                8 * std::numeric_limits<double>::denorm_min() / unit_;
    resolution_ = resolution_of_size * std::max(a.size, b.size) / unit_;
  }

  // Returns the support point of C in a direction, s_A(d) - s_B(-d) less the target: of all points of C one with the
  // greatest d . w. The direction has any length but zero.
  SupportPoint support(const Vec3d& direction) {
    ++support_calls_;
    const Vec3d d = direction.stableNormalized();
    const Vec3d a = in_unit(a_, rotation_a_, d, Vec3d::Zero());
    const Vec3d b = in_unit(b_, rotation_b_, -d, offset_);
    return {a - b - target_, a, b};
  }

  // Moves the origin of C to this point: a test of whether the point is in C is then one of whether the origin is.
  void aim(const Vec3d& target) { target_ = target; }

  // The difference of the bodies' origins, which is in C unless a hull is away from its own origin.
  Vec3d origins() const { return -offset_ / unit_; }

  // False if the bodies are too large or too far apart for doubles.
  bool is_finite() const { return is_finite_; }
  double unit() const { return unit_; }  // metres
  // Greatest error of d . w for a unit vector d, of the products, the choice of the point and the sums together.
  double rounding() const { return rounding_; }
  // The widest bounds on the signed distance that may be called `touching`.
  double resolution() const { return resolution_; }
  int support_calls() const { return support_calls_; }
  Vec3d to_world(const Vec3d& point) const { return origin_ + unit_ * point; }

 private:
  static constexpr double resolution_of_size = 5.9e-14;

  // At least the greatest stretch by the matrix; 1 for a rotation.
  static double stretch(const Pose& pose) {
    return std::max(1.0, pose.rotation.norm() / std::sqrt(3.0) - 1e-12);
  }

  // A ball is not deformed by a matrix that is no rotation, unlike what is inside of it.
  Vec3d in_unit(const Shape& shape, const Pose& rotation, const Vec3d& d,
                const Vec3d& place) const {
    switch (shape.kind) {
      case ShapeKind::sphere: return (place + shape.radius * d) / unit_;
      case ShapeKind::capsule: {
        const Vec3d end = rotation.rotation.col(2) * shape.half_length;
        return (place + (d.dot(end) < 0 ? Vec3d(-end) : end) + shape.radius * d) / unit_;
      }
      default: return (place + support_point(shape, rotation, d)) / unit_;
    }
  }

  const Shape &a_, &b_;
  Vec3d origin_, offset_, target_ = Vec3d::Zero();
  Pose rotation_a_, rotation_b_;
  bool is_finite_;
  double unit_, rounding_, resolution_;
  int support_calls_ = 0;
};

// Calls solve(difference, outcome) for each pair of a batch; bodies beyond doubles are degenerate.
template <class Solve>
void for_each_difference(const std::vector<BoundShape>& shapes, const BodyPairs& pairs,
                         std::span<Outcome> outcomes, const Solve& solve) {
  for (std::size_t i = 0; i < pairs.first.size(); ++i) {
    const std::uint32_t a = pairs.first[i], b = pairs.second[i];
    Difference c(shapes[pairs.shape_of[a]], pairs.poses[a], shapes[pairs.shape_of[b]],
                 pairs.poses[b]);
    outcomes[i] = {.status = Status::degenerate, .iterations = 0};
    if (c.is_finite()) solve(c, outcomes[i]);
    outcomes[i].support_calls = c.support_calls();
  }
}

// A half-space has no support point in most directions.
inline bool are_bounded(ShapeKind /*kind_a*/, ShapeKind kind_b, Task /*task*/) {
  return kind_b != ShapeKind::halfspace;
}

}  // namespace touchstone::textbook
