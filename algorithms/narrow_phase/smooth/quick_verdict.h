// Part of smooth: a verdict of two round bodies from the line of their centres and a few planes,
// without a search. Includes core and kernels.
// Steps:   1. The plane across the line of centres separates the bodies, or
//          2. the parts of that line within the bodies meet: the gauge of each body gives its part, so
//             they overlap.
//          3. Otherwise try the plane across the line between the support points, and one across the
//             nearest point of the last two such lines, as GJK would.
// Paper:   gauge and support function: Schneider, "Convex Bodies: The Brunn-Minkowski Theory", 1993,
//          sec. 1.7.
#pragma once

#include "algorithms/core/outcome.h"
#include "algorithms/core/pose.h"
#include "algorithms/kernels/minkowski/support_shape.h"

namespace touchstone {

// A sphere, capsule, cylinder, cone or ellipsoid around its origin.
struct RoundShape {
  explicit RoundShape(const Shape& shape);

  SupportCore core;
  double x, y, z;  // half axes of the core, metres
  double radius;   // of the ball around it
  bool is_solid;   // it has a volume, so that every direction has a gauge
};

struct QuickVerdict {
  Answer answer = Answer::unknown;  // or separated, overlapping: proven beyond rounding
  int planes = 0;
};

// The poses must be rotations up to 1e-12 (`smooth_pair.h`).
QuickVerdict quick_verdict(const RoundShape& a, const Pose& pose_a, const RoundShape& b,
                           const Pose& pose_b);

}  // namespace touchstone
