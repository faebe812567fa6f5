// Bounds on the signed distance of a body and a half-space that rounding cannot break: the height
// of the body's lowest point over the plane, in doubles or in long double, from the numbers of the
// shapes and poses as they stand. The moved plane's normal is the inverse transpose of the matrix
// times n, whether that is a rotation or not.
// Paper: Wilkinson, "Rounding Errors in Algebraic Processes", 1963 (the bounds); Ericson,
// "Real-Time Collision Detection", 2005, section 5.2.3 (a box and a half-space).
#pragma once

#include "algorithms/core/pose.h"
#include "algorithms/narrow_phase/certified/proven_support.h"

namespace touchstone {

// Of body a, which is bounded, over body b, which is a half-space.
class HeightProver {
 public:
  // `normal` becomes the plane's, outward, in the world. Nothing is proven of a matrix that is
  // singular up to rounding, or where a long double has no wider range than a double.
  ProvenGap closely(const ProvenShape& a, const Pose& pose_a, const ProvenShape& b,
                    const Pose& pose_b, Vec3d& normal);
  // A wider interval, but soon.
  static ProvenGap roughly(const ProvenShape& a, const Pose& pose_a, const ProvenShape& b,
                           const Pose& pose_b);

 private:
  std::vector<std::uint32_t> furthest_;  // hulls: vertices that may be
  std::vector<double> values_;
};

}  // namespace touchstone
