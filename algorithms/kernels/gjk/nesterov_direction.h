// The search direction of Nesterov-accelerated GJK. Used by gjk_distance.inl for gjk-nesterov and
// gjk-switched.
// Paper: Montaut, Le Lidec, Petrik, Sivic, Carpentier, "Collision detection accelerated: an
// optimization perspective", RSS 2022, algorithm 3.
#pragma once

#include "algorithms/core/vec.h"

namespace touchstone {

// Directions point towards the origin, like the direction of a support call.
template <class Scalar>
class NesterovDirection {
 public:
  // `start` is the point of the difference at which the search starts. Normalising keeps a corner,
  // whose support point stays in place, from dominating the average.
  NesterovDirection(bool normalised, const Vec3<Scalar>& start)
      : normalised_(normalised), direction_(start) {}

  // `nearest` is the simplex's point nearest to the origin, `support` the newest support point.
  Vec3<Scalar> next(const Vec3<Scalar>& nearest, const Vec3<Scalar>& support) {
    const Scalar k = static_cast<Scalar>(step_++);
    const Scalar weight = (normalised_ ? k + 2 : k + 1) / (k + 3);
    Vec3<Scalar> ahead = weight * nearest + (1 - weight) * support;
    if (normalised_) {
      ahead = unit(ahead);
      direction_ = unit(direction_);
    }
    direction_ = weight * direction_ + (1 - weight) * ahead;
    return -unit(direction_);
  }

 private:
  static Vec3<Scalar> unit(const Vec3<Scalar>& v) {
    const Scalar length = v.norm();
    return length > 0 ? Vec3<Scalar>(v / length) : v;
  }

  bool normalised_;
  int step_ = 1;
  Vec3<Scalar> direction_;
};

}  // namespace touchstone
