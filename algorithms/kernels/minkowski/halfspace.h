// A half-space against anything else: one support call, or none.
//
// The plane is that of the moved points, whatever the matrix: its normal is the inverse transpose
// times n.
// Paper: Ericson, "Real-Time Collision Detection", 2005, section 5.2.3 (a box and a half-space).
#pragma once

#include "algorithms/core/outcome.h"
#include "algorithms/kernels/minkowski/support.h"

namespace touchstone {

// Body a is bounded, body b is a half-space. Writes what the task asks for into the outcome. The
// distance is exact up to rounding; where rounding hides its sign, the answer is unknown and the
// status not_converged.
template <class Scalar>
void solve_halfspace(const SupportShape<Scalar>& a, const Pose& pose_a,
                     const SupportShape<Scalar>& b, const Pose& pose_b, Task task,
                     Outcome& outcome);

// Two half-spaces overlap unless their normals are opposite: then the gap or the common slab says
// how far. Normals that are opposite up to rounding are taken to be so. Other pairs overlap without
// bound: no translation separates them, and a penetration query is degenerate.
template <class Scalar>
void solve_halfspaces(const SupportShape<Scalar>& a, const Pose& pose_a,
                      const SupportShape<Scalar>& b, const Pose& pose_b, Task task,
                      Outcome& outcome);

}  // namespace touchstone
