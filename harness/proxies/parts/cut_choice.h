// Chooses the plane that cuts a piece.
#pragma once

#include <vector>

#include "harness/proxies/parts/piece.h"

namespace touchstone::proxies {

// Returns the parts on both sides of the plane that leaves least volume in the hulls of the parts,
// or none if no plane leaves less than the piece's hull has. The planes are perpendicular to `axes`
// and to the piece's principal axes, and those of the faces beside the sharpest concave edges. Where
// the best of them takes away less than a third of the concavity, as a ring's first does, each of
// the better ones and of those through the centre is tried with the best cut of each of its parts.
// `sign` is the sign of the whole mesh's volume. Around a closed cavity two cuts gain nothing, so
// such a piece is not cut.
std::vector<Piece> best_cut(const Piece& piece, const Mat3d& axes, double sign);

}  // namespace touchstone::proxies
