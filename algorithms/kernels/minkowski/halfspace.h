// A half-space against any other shape: one support call, or none. Used by gjk, gjk-templated, mpr,
// mpr-refined, closed-form, sat, sat-faces and clipped-faces.
//
// The plane is the image of the points under the matrix, whatever it is: its normal is the inverse
// transpose times n.
// In double, points, segments, boxes and hulls are solved in doubles with a bound on their rounding. Where the bound is
// too wide (tilted planes, centres far away, matrices that are no rotations), and for all other bodies, long doubles
// give the plane's height.
// Paper:   Ericson, "Real-Time Collision Detection", 2005, section 5.2.3 (a box and a half-space).
#pragma once

#include <span>

#include "algorithms/core/body_pairs.h"
#include "algorithms/core/outcome.h"
#include "algorithms/kernels/minkowski/support.h"

namespace touchstone {

// Solves a pair of a bounded body a and a half-space b. The distance is exact up to rounding. If
// rounding hides its sign, the answer is `touching` with bounds (resolution.h), or `unknown` with the
// status `not_converged` if the bounds are too far apart for that.
template <class Scalar>
void solve_halfspace(const SupportShape<Scalar>& a, const Pose& pose_a,
                     const SupportShape<Scalar>& b, const Pose& pose_b, Task task,
                     Outcome& outcome);

// Solves such pairs. What depends on the plane alone is computed once while the same half-space follows.
template <class Scalar>
void solve_halfspace_batch(std::span<const SupportShape<Scalar>> shapes, const BodyPairs& pairs,
                           Task task, std::span<Outcome> outcomes);

// Solves a pair of half-spaces. They overlap unless their normals are opposite, up to rounding;
// then the distance is the gap, or minus the thickness of the common slab. Other pairs overlap
// without bound: no translation separates them, and a penetration query is `degenerate`.
template <class Scalar>
void solve_halfspaces(const SupportShape<Scalar>& a, const Pose& pose_a,
                      const SupportShape<Scalar>& b, const Pose& pose_b, Task task,
                      Outcome& outcome);

}  // namespace touchstone
