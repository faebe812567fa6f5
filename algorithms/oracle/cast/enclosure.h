// Part of the oracle, used by exact_cast and prove_cast: the time of impact of bodies that turn, or are curved,
// between bounds.
#pragma once

#include <vector>

#include "algorithms/core/cast_outcome.h"
#include "algorithms/core/motion.h"
#include "algorithms/core/pose.h"
#include "algorithms/core/shape.h"
#include "algorithms/oracle/oracle.h"

namespace touchstone::oracle {

// A body that moves. `reach` is the greatest distance of its points from its origin (metres, rounded
// up), or 0 for a half-space, which must not turn.
struct EnclosedBody {
  const Solid* solid;
  const Pose* pose;
  const Motion* motion;
  double reach;
};

EnclosedBody enclosed(const Shape& shape, const Solid& solid, const Pose& pose,
                      const Motion& motion);

// The pose at a time, rounded to doubles; its origin is given in the frame of `from`, whose origin moves
// with it and whose axes are the world's.
Pose rounded_pose(const EnclosedBody& body, const EnclosedBody& from, double time);

// A plane with this normal, from a to b, that parts the bodies until a time.
struct PartedUntil {
  Vec3d normal;
  double time;
};

struct EnclosureGoal {
  double tolerance;  // the path in the bracket of a hit is narrowed to about that (metres)
  int most_steps = 20000;
};

// Writes a miss or a hit only if it is proven; otherwise the answer is unknown and the status
// not_converged, with a proven `lower`. Adds the planes that parted the bodies, in order of time.
void enclose(Oracle& oracle, const EnclosedBody& a, const EnclosedBody& b,
             const EnclosureGoal& goal, CastOutcome& outcome,
             std::vector<PartedUntil>* planes = nullptr);

}  // namespace touchstone::oracle
