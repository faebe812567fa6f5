// Part of the oracle, used by the checks of certificates: poses in rationals.
#pragma once

#include "algorithms/oracle/certificates/rationals.h"
#include "algorithms/oracle/solid.h"

namespace touchstone::oracle {

// Maps x to rows * x + translation.
struct RationalPose {
  std::array<RationalVector, 3> rows;
  RationalVector translation;

  RationalVector operator()(const RationalVector& x) const;
};

// Exact. They throw Fault if a number is not finite, or the quaternion is zero.
RationalPose rational_pose(const Pose& pose);
RationalPose rational_pose(const Body& body);

// `inner` followed by `outer`.
RationalPose composed(const RationalPose& outer, const RationalPose& inner);

}  // namespace touchstone::oracle
