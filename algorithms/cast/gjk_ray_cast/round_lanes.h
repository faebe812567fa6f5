// Part of gjk-ray-cast-lanes: two spheres or capsules that move without turning, a pair in each lane.
//
// The difference of their axes is a parallelogram about 0 with the half sides p and q, past which the offset x
// of the centres moves. The distance of x from it is a convex function of time, and the plane at its nearest
// point is a tangent: going on to where the gap of that plane closes is Newton's method from below, which
// never goes too far and converges like it. The first plane is that of the time at which the centres are
// nearest, which most misses need no other of.
//
// Rounding. With u = 2^-53 and S the sum of |x|, |v|, |p|, |q| and the radii, a gap along a unit vector is off
// by 3 u for products with it, 3 u for its length, u for each of offset, velocity and sides, 4 u for sums and
// 2 u for the time: in all 14 u S. The bound is 48 u S.
#pragma once

#include <span>

#include "algorithms/cast.h"
#include "algorithms/cast/gjk_ray_cast/lane_times.h"

namespace touchstone {

// What one pair needs: metres, world axes.
struct RoundLane {
  double side_a[3], side_b[3];    // p and q: the half axes, zero for spheres
  double offset[3], velocity[3];  // of b's centre from a's
  double radius_a, radius;        // of a, and of both together
  double tolerance;
};

// Refuses numbers that are beyond the proof: lengths whose squares are.
LaneLoad load_round_lane(const Shape& a, const Pose& pose_a, const Motion& motion_a, const Shape& b,
                         const Pose& pose_b, const Motion& motion_b, RoundLane& lane);

// Both have the same size.
void cast_round(std::span<const RoundLane> lanes, std::span<LaneTimes> times);

}  // namespace touchstone
