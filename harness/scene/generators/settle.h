// Two bodies at a given distance, by the exact answer.
#pragma once

#include "algorithms/oracle/oracle.h"

namespace touchstone {

// Moves b along the shortest connection, or separating translation, until the signed distance
// (metres) is right, to a millionth part of it or to 4e-16; on the way another feature may become
// the nearest. False where that does not come to an end.
bool settle(oracle::Oracle& oracle, const oracle::Solid& a, const Pose& at_a,
            const oracle::Solid& b, Pose& at_b, double distance);

// Moves b straight on along `way`, a unit vector, to where the signed distance is right, as
// exactly: from a place where it is greater, to the first such place. False where there is none.
bool meet(oracle::Oracle& oracle, const oracle::Solid& a, const Pose& at_a, const oracle::Solid& b,
          Pose& at_b, const Vec3d& way, double distance);

}  // namespace touchstone
