// A body that turns, and a half-space that does not. Used by conservative-advancement, rigid-advancement and
// bilateral-advancement.
#pragma once

#include "algorithms/kernels/motion/advancement/advancement.h"

namespace touchstone {

// Solves a pair whose body b is a half-space. Where that turns, or a is one and turns, the pair is unsupported.
void advance_onto_halfspace(const MovingBody& a, const MovingBody& b, const AdvancementGoal& goal,
                            CastOutcome& outcome);

}  // namespace touchstone
