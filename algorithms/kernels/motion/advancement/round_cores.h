// The closest points of cores that are points and segments, in closed form. Used by the loop of conservative
// advancement (advancement.h) and the proof of contact (contact_by.h).
// Paper:   Ericson, "Real-Time Collision Detection", 2005, section 5.1.9.
#pragma once

#include "algorithms/kernels/minkowski/support.h"

namespace touchstone {

// In the pair's unit: each point from its own body's centre, the vector between them, from a to b, and what part of
// its half axis each point is, in [-1, 1].
struct ClosestOfRound {
  Vec3d on_a, on_b, between;
  double part_a, part_b;
};

// True if both bodies are spheres or capsules.
inline bool is_round(SupportPair<double>& pair) {
  return pair.a().shape().core <= SupportCore::segment &&
         pair.b().shape().core <= SupportCore::segment;
}

// From the centre of a core that is a point or a segment to its end.
Vec3d half_axis(const PosedShape<double>& shape);

// For segments from -p to p and from offset - q to offset + q, or points.
ClosestOfRound closest_of_segments(const Vec3d& p, const Vec3d& q, const Vec3d& offset);

// For a pair that is round. The points lie on the cores whatever rounding does to the choice of them.
ClosestOfRound closest_of_round(SupportPair<double>& pair);

}  // namespace touchstone
