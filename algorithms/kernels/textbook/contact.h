// What a search for the distance may say where it ends at the origin: overlapping, touching or unknown. Used by
// gjk-textbook, gjk-signed-volumes, epa-textbook, mpr-textbook and sat-textbook.
//
// A search ends there if the origin is within rounding of C, which does not say on which side of its surface. The bodies
// are called overlapping only if a ball around the origin is proven to be in C.
#pragma once

#include <array>
#include <cmath>
#include <utility>

#include "algorithms/core/outcome.h"
#include "algorithms/kernels/textbook/difference.h"

namespace touchstone::textbook {

// Bounds on the distance of the origin from C, in its unit, rounding included.
struct Bounds {
  double lower, upper;
  // True if they are as close as the tolerance asks, as far as rounding allows.
  bool have_met(double tolerance, const Difference& c) const {
    return upper - lower <= tolerance + 4 * c.rounding();
  }
};

// Returns true if the origin is inside the tetrahedron by more than rounding. Points of C within `rounding` of these then
// enclose it too.
inline bool encloses_origin(const std::array<Vec3d, 4>& corners, double rounding) {
  for (int k = 0; k < 4; ++k) {
    const Vec3d &p = corners[(k + 1) % 4], &q = corners[(k + 2) % 4], &r = corners[(k + 3) % 4];
    const Vec3d side = q - p, other = r - p, normal = side.cross(other);
    const double length = normal.norm(), height = normal.dot(p);
    // The error of a normal grows as its two sides become parallel.
    const double doubt = rounding * (length + side.norm() * other.norm());
    const bool is_same_side = (normal.dot(corners[k] - p) > 0) == (height < 0);
    if (!(std::abs(height) > doubt) || !is_same_side) return false;
  }
  return true;
}

inline void write_overlapping(Outcome& outcome) {
  outcome.answer = Answer::overlapping;
  outcome.status = Status::ok;
}

// Writes bounds on the signed distance (in the unit of C) and `touching` at a distance of 0, or `unknown` if they are too far apart.
inline void write_undecided(const Difference& c, double lower, double upper, Outcome& outcome) {
  const bool touches = lower <= 0 && upper >= 0 && upper - lower <= c.resolution();
  outcome.answer = touches ? Answer::touching : Answer::unknown;
  outcome.status = touches ? Status::ok : Status::not_converged;
  outcome.lower = lower * c.unit();
  outcome.upper = upper * c.unit();
  if (touches) outcome.distance = 0;
}

// Decides a search that found the origin within `upper` of C. `search()` bounds the distance of the origin from C anew; it is
// asked for the corners of a regular tetrahedron about the origin instead. If C holds them to rounding, the bodies overlap; if
// one is outside, they overlap by no more than it is away.
template <class Search>
void decide_contact(Difference& c, double upper, const Search& search, Outcome& outcome) {
  const double inside = 3 * c.rounding(), away = 3 * inside;  // inscribed and circumscribed ball
  const double part = away / std::sqrt(3.0);
  bool holds_all = true, one_is_outside = false;
  for (const Vec3d& corner :
       {Vec3d(1, 1, 1), Vec3d(1, -1, -1), Vec3d(-1, 1, -1), Vec3d(-1, -1, 1)}) {
    c.aim(part * corner);
    const Bounds found = search();
    one_is_outside = found.lower > 0;
    holds_all = holds_all && !one_is_outside && found.upper < inside;
    if (one_is_outside) break;
  }
  c.aim(Vec3d::Zero());
  if (holds_all) return write_overlapping(outcome);
  write_undecided(c, one_is_outside ? -away : Outcome::none, upper, outcome);
}

// Answers by a search for the point of C that is nearest to the origin, for Task::intersect and Task::distance.
// `search(wants_distance)` returns the `distance` (Bounds), the `simplex` with the combinations `nearest(part)` of its points'
// members, the unit vector `direction()` from the origin, and whether the origin `is_enclosed` by the simplex.
template <class Search>
void answer_distance(Difference& c, Task task, double tolerance, const Search& search,
                     Outcome& outcome) {
  const bool wants_distance = task == Task::distance;
  const auto found = search(wants_distance);
  const Bounds& distance = found.distance;
  if (found.is_enclosed) return write_overlapping(outcome);
  if (!(distance.lower > 0)) {
    if (distance.upper > 2 * c.rounding())
      return write_undecided(c, Outcome::none, distance.upper, outcome);
    return decide_contact(
        c, distance.upper, [&] { return search(false).distance; }, outcome);
  }
  outcome.answer = Answer::separated;
  outcome.status =
      !wants_distance || distance.have_met(tolerance, c) ? Status::ok : Status::not_converged;
  if (!wants_distance) return;
  outcome.distance = c.unit() * found.simplex.nearest(&SupportPoint::w).norm();
  outcome.lower = c.unit() * distance.lower;
  outcome.upper = c.unit() * distance.upper;
  outcome.normal = -found.direction();
  outcome.witness_a = c.to_world(found.simplex.nearest(&SupportPoint::a));
  outcome.witness_b = c.to_world(found.simplex.nearest(&SupportPoint::b));
}

}  // namespace touchstone::textbook
