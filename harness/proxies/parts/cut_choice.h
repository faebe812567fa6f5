// Chooses the plane that cuts a piece.
#pragma once

#include <vector>

#include "harness/proxies/parts/piece.h"

namespace touchstone::proxies {

// Returns the parts on both sides of the plane that leaves least volume in the hulls of the parts. The planes are perpendicular to `axes`
// and to the piece's principal axes, and those of the faces beside the sharpest concave edges. Where
// the best of them takes away less than a third of the concavity, as a ring's first does, each of
// the better ones and of those through the centre is tried with the best cut of each of its parts.
// If even two cuts gain nothing, as around a cavity, it is the plane that leaves the smallest hulls
// of parts that are not convex; there is none if that is nearly the whole piece.
// `sign` is the sign of the whole mesh's volume.
std::vector<Piece> best_cut(const Piece& piece, const Mat3d& axes, double sign);

}  // namespace touchstone::proxies
