// Part of the oracle, used by exact.cpp and certified: the exact answer as a narrow phase's
// outcome.
#pragma once

#include "algorithms/core/outcome.h"
#include "algorithms/oracle/oracle.h"

namespace touchstone::oracle {

// Writes the outcome that the task asks for: the distance, rounded once, and witness points
// (metres, world) that are sums of the bodies' own points, computed in doubles. If an enclosure of
// curved cores contains zero, the answer is `unknown` and the status `not_converged`.
void answer(Oracle& oracle, const Body& a, const Body& b, Task task, Outcome& outcome);

}  // namespace touchstone::oracle
