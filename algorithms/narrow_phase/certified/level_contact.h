// Part of certified: boxes that stand level, and a box that stands level on a half-space. Includes
// core.
//
// A body is level along an axis of the world if its extent along that axis is one of its own half
// extents, since its matrix has a single number there, 1 or -1. The gap of two such bodies is then a
// sum of four doubles, whose sign is exact.
// Paper:   Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric
//          predicates", Discrete & Computational Geometry 18, 1997 (sums of doubles).
// Steps:   1. Compute the gap along each axis along which both bodies are level. A gap above zero
//             separates them.
//          2. If they are level along all axes and no gap is above zero, they touch where one is
//             zero, and overlap where none is. The gaps give the distance, or the depth, too.
//          3. If a gap is zero and they are turned about its axis, find a point of b's face that is
//             well within a's, in doubles: then they touch.
// Fails:   proves nothing for other pairs, nor numbers of turned boxes that do not touch.
#pragma once

#include "algorithms/core/outcome.h"
#include "algorithms/core/pose.h"
#include "algorithms/core/shape.h"

namespace touchstone {

// False if the matrix surely leaves no box level along any axis.
inline bool may_be_level(const Mat3d& rotation) {
  const double* const m = rotation.data();
  return (m[0] * m[1] * m[2]) * (m[3] * m[4] * m[5]) * (m[6] * m[7] * m[8]) == 0;
}

// Decides two boxes; returns false, and writes nothing, if that proves not all that the task asks.
bool decide_level_boxes(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b,
                        Task task, Outcome& outcome);

// Decides a box and a half-space whose plane is level and not turned.
bool decide_level_plane(const Shape& box, const Pose& pose, const Shape& halfspace,
                        const Pose& pose_of_plane, Task task, Outcome& outcome);

}  // namespace touchstone
