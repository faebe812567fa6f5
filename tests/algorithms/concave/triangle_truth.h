// The truth about two triangles, in integers of GMP and with no code of the algorithms.
#pragma once

#include "algorithms/core/pose.h"
#include "harness/families/triangle_pairs.h"

namespace touchstone::reference {

// True if the closed triangles, each under its pose, share a point: no axis of a complete set
// separates them.
bool triangles_meet(const families::TrianglePair& pair);

}  // namespace touchstone::reference
