// The outcome of a cast. Everything may include this.
#pragma once

#include <cstdint>
#include <limits>
#include <string_view>

#include "algorithms/core/status.h"
#include "algorithms/core/vec.h"

namespace touchstone {

// What it means that the bodies are in contact at time 0.
enum class StartContact : std::uint8_t {
  counts,  // a hit at time 0, whatever happens then
  // A hit only if the bodies approach. They do not if some fixed direction exists along which they
  // are no deeper than the tolerance in each other at any time of the motion: bodies that touch and
  // slide, part or rest are a miss, whether they touch in a vertex, an edge or a face, and so are flat
  // bodies that move in their common plane. The tolerance takes up what rounding did to a touch: the
  // start may be that deep, and bodies that get that deep and no deeper by time 1 do not approach yet.
  // A depth that differs from the tolerance by rounding alone is taken as either. Where the least depth
  // cannot be told from the tolerance otherwise, the answer is unknown, with the status not_converged
  // and `lower` 0. For motions without rotation.
  approach,
};

enum class CastAnswer : std::uint8_t { hit, miss, unknown };

std::string_view to_string(CastAnswer answer);

// Fields that are not known are NaN. A miss has none but the iterations. CastEntry says which hits have a
// normal and a point.
struct CastOutcome {
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();

  CastAnswer answer = CastAnswer::unknown;
  // With `ok`, a miss is proven: the bodies share no point at any time in [0, 1] (or, with
  // StartContact::approach, do not approach). A hit says that at `toi` they are no further apart
  // than the tolerance. Where rounding hides more than a tolerance that was asked for, it comes with a proof of
  // contact, which is `upper`, or is unknown / not_converged.
  Status status = Status::unsupported;
  double toi = none;  // the first time at which the closed bodies share a point; 0 at the start
  // Certified bounds, where the algorithm has them: no point is shared before `lower`, and some is
  // by `upper`. An answer `unknown` may have the first.
  double lower = none;
  double upper = none;
  Vec3d normal = Vec3d::Constant(none);  // unit vector from a to b at that time, world axes
  Vec3d point = Vec3d::Constant(none);   // where they touch at that time, metres in the world
  std::int32_t iterations = -1;          // -1: not counted
};

}  // namespace touchstone
