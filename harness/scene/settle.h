// Two bodies at a given distance, by the exact answer.
#pragma once

#include "algorithms/oracle/oracle.h"

namespace touchstone {

// Moves b along the shortest connection, or separating translation, until the signed distance
// (metres) is right, to a millionth part of it or to 4e-16; on the way another feature may become
// the nearest. False where that does not come to an end.
bool settle(oracle::Oracle& oracle, const oracle::Solid& a, const Pose& at_a,
            const oracle::Solid& b, Pose& at_b, double distance);

}  // namespace touchstone
