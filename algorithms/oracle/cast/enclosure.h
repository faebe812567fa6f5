// Part of the oracle, used by exact_cast alone: the time of impact of bodies that turn, or are curved,
// between bounds.
#pragma once

#include <optional>

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

// Writes a miss or a hit only if it is proven; otherwise the answer is unknown and the status
// not_converged, with a proven `lower`. The bracket of a hit is narrowed to a path of about
// `tolerance` (metres).
void enclose(Oracle& oracle, const EnclosedBody& a, const EnclosedBody& b, double tolerance,
             CastOutcome& outcome);

}  // namespace touchstone::oracle
