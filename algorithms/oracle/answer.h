// The oracle's answer as a narrow phase's outcome.
#pragma once

#include "algorithms/core/outcome.h"
#include "algorithms/oracle/oracle.h"

namespace touchstone::oracle {

// Writes what the task asks for: a distance rounded once, witness points (metres, world) that are
// sums of the bodies' own points, rounded as doubles are. Where an enclosure of curved cores holds
// zero the answer is unknown, and the status not_converged.
void answer(Oracle& oracle, const Body& a, const Body& b, Task task, Outcome& outcome);

}  // namespace touchstone::oracle
