// Half-spaces that move without turning: the gap along the plane's normal is linear in time. Used
// by all our casts.
#pragma once

#include <optional>

#include "algorithms/core/cast_outcome.h"
#include "algorithms/core/motion.h"
#include "algorithms/core/pose.h"
#include "algorithms/kernels/minkowski/support_shape.h"

namespace touchstone {

// How the bodies' contact at time 0 is taken, and the tolerance of a hit in metres: by default 1e-9 of the
// bounded body's size. It is no less than what rounding hides.
struct HalfspaceCastGoal {
  std::optional<double> tolerance = {};
  StartContact start = StartContact::counts;
};

// Solves a pair whose body b is a half-space, and a is any body, also a half-space.
void cast_halfspace(const SupportShape<double>& a, const Pose& pose_a, const Motion& motion_a,
                    const SupportShape<double>& b, const Pose& pose_b, const Motion& motion_b,
                    const HalfspaceCastGoal& goal, CastOutcome& outcome);

}  // namespace touchstone
