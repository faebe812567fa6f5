// Part of the oracle, used by exact_cast: whether bodies that do not turn, and are in contact at the start, approach.
//
// Along a fixed direction the bodies are deepest at the start or at the end, because the depth is linear in time.
// So the least depth that any direction keeps is that of b in all that a covers while it moves past b: one
// question for the oracle.
#pragma once

#include "algorithms/core/motion.h"
#include "algorithms/oracle/oracle.h"

namespace touchstone::oracle {

enum class Approach : std::uint8_t { no, yes, unknown };

// The bodies approach if they get deeper into each other than the tolerance (metres) along every fixed direction; see
// StartContact. Decided exactly for polytopes, balls around them, and half-spaces; of other bodies unknown where the
// enclosure of the depth holds the tolerance. Neither motion turns.
Approach approach(Oracle& oracle, const Body& a, const Motion& motion_a, const Body& b,
                  const Motion& motion_b, double tolerance);

}  // namespace touchstone::oracle
