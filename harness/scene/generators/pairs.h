// Places two bodies at a given exact distance, as the generator `pairs` does.
#pragma once

#include "algorithms/oracle/oracle.h"

namespace touchstone::scene {

// Places two bodies at a given exact distance.

// Moves b along the shortest connection, or separating translation, until the signed distance
// (metres) is correct to one millionth of it or to 4e-16. The nearest features may change on the
// way. Returns false if this does not converge.
bool settle(oracle::Oracle& oracle, const oracle::Solid& a, const Pose& at_a,
            const oracle::Solid& b, Pose& at_b, double distance);

// Moves b straight along `way`, a unit vector, to the first place where the signed distance is
// correct to that precision. It must be greater at the start. Returns false if there is no such
// place.
bool meet(oracle::Oracle& oracle, const oracle::Solid& a, const Pose& at_a, const oracle::Solid& b,
          Pose& at_b, const Vec3d& way, double distance);

}  // namespace touchstone::scene
