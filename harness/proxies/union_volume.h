// Volumes of unions of solids, by integration along lines.
#pragma once

#include <vector>

#include "harness/proxies/placed_solid.h"

namespace touchstone::proxies {

// Metres cubed.
struct Overlap {
  double body = 0, added = 0, lost = 0;  // the body; what is outside it; what of it is missing
  double deviation = 0;                  // standard error of (added + lost) / body; 0: rounding
};

// Compares the union of `body` and of the points around which `closed` winds (the triangles of a
// closed surface) with the union of `parts`. Lines along z form eight lattices of 4,096 points
// (Roberts' sequence of the plastic number), each shifted at random; lengths along a line are
// exact. The caller should rotate the solids so that they fill their box in x and y.
//
// The volumes of the single solids are known, and so is the integral of the winding number. Lines
// measure only by how much a union differs from their sum, which is nothing where solids do not
// overlap. So a volume that is known has no error, nor has a difference of two of which one holds
// the other.
Overlap overlap_of(const std::vector<PlacedSolid>& body,
                   const std::vector<geometry::Triangle>& closed,
                   const std::vector<PlacedSolid>& parts);

}  // namespace touchstone::proxies
