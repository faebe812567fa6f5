// Part of gjk-ray-cast-lanes: two boxes that move without turning, a pair in each lane, by the times at
// which their shadows on the 15 axes of faces and pairs of edges meet and part.
//
// With an axis n, o and v the offset of the centres at time 0 and the displacement, and reach the sum of
// |n . e| over the half edges e, the shadows overlap while |n . o + t n . v| <= reach. A face of the
// difference of the boxes has one of these axes as its normal, so that the boxes share a point exactly
// where all shadows overlap.
//
// Rounding. Let u = 2^-53 and S the sum of |o|, |v| and all half edges. A component of n is off by 4 u, as
// columns are at most 1.01 long; a product with n by 12 u of the vector's length, the offset by u, sums by
// 4 u more, the time by 4 u times n . v <= S. The bound on a gap is 128 u S, more than twice the sum. A
// shadow is taken to part the boxes if its gap is above that bound, and to overlap if it is below minus that.
// Edges that are parallel up to an angle of 1e-9 have no axis that doubles can name. A box whose edges are
// turned by that angle until they are parallel has no face there. It is off by at most the angle times the
// sizes, and its shadows on the other axes by at most six times that, since the axes turn too and the
// offset is no longer than the boxes reach. If these shadows overlap by sixteen times it, the turned
// difference holds a ball about 0 that the true one must reach.
#pragma once

#include <span>
#include <vector>

#include "algorithms/cast.h"
#include "algorithms/cast/gjk_ray_cast/lane_times.h"

namespace touchstone {

// What one pair needs: metres, world axes.
struct BoxLane {
  double columns_a[9], columns_b[9];  // of the matrices
  double extents_a[3], extents_b[3];
  double offset[3], velocity[3];  // of b's centre from a's
  double tolerance;
};

// Refuses numbers that are beyond the proof: matrices far from rotations, or lengths whose squares are.
LaneLoad load_box_lane(const Shape& a, const Pose& pose_a, const Motion& motion_a, const Shape& b,
                       const Pose& pose_b, const Motion& motion_b, BoxLane& lane);

// Both have the same size. The path in the bracket of a hit is within the tolerance.
void cast_boxes(std::span<const BoxLane> lanes, std::span<LaneTimes> times);

}  // namespace touchstone
