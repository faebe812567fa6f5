// Part of smooth: a verdict of two round bodies from the line of their middles and a few planes,
// without a search. Includes core and kernels.
// Steps:   1. The plane across the line of the middles separates the bodies, or
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
  double x, y, z;              // half axes of the core, metres
  double radius;               // of the ball around it
  double middle;               // z of the middle: that of a cone is its centre of mass
  bool is_solid;               // it has a volume, and its gauge in every direction has its digits
  double size;                 // sum of all of these, metres
  double per_x, per_y, per_z;  // the inverses of the half axes
};

struct QuickVerdict {
  Answer answer = Answer::unknown;  // or separated, overlapping: proven beyond rounding
  int planes = 0;
  // Separated: a normal from a to b, of any length, and a lower bound on the gap along it in metres,
  // times that length.
  Vec3d normal = Vec3d::Zero();
  double gap = 0;
};

// Bodies whose matrices are not rotations up to 1e-12 (`smooth_pair.h`) are at most separated by the
// first plane.
QuickVerdict quick_verdict(const RoundShape& a, const Pose& pose_a, const RoundShape& b,
                           const Pose& pose_b);

}  // namespace touchstone
