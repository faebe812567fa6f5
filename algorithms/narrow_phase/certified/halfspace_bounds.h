// Part of certified: bounds on the signed distance of a body and a half-space that rounding cannot
// break. It is the height of the body's lowest point over the plane, in double or long double, from
// the literal numbers of shapes and poses. The transformed plane's normal is the inverse transpose
// of the matrix times n, for any matrix. Includes core and this folder.
// Paper:   Wilkinson, "Rounding Errors in Algebraic Processes", 1963 (the bounds); Ericson,
//          "Real-Time Collision Detection", 2005, section 5.2.3 (a box and a half-space).
#pragma once

#include "algorithms/core/pose.h"
#include "algorithms/narrow_phase/certified/support_bounds.h"

namespace touchstone {

// Bounds the height of body a, which is bounded, over body b, which is a half-space.
class HalfspaceBounder {
 public:
  // `normal` receives the plane's outward normal in the world. Proves nothing if the matrix is
  // singular up to rounding, or if long double has no wider range than double.
  DistanceBounds closely(const BoundedShape& a, const Pose& pose_a, const BoundedShape& b,
                         const Pose& pose_b, Vec3d& normal);
  // Returns a wider interval, faster.
  static DistanceBounds roughly(const BoundedShape& a, const Pose& pose_a, const BoundedShape& b,
                                const Pose& pose_b, Vec3d& normal);

 private:
  std::vector<std::uint32_t> furthest_;  // hulls: vertices that may be furthest
  Eigen::ArrayXd values_;
};

}  // namespace touchstone
