// Volumes of unions of solids, by integration along lines.
#pragma once

#include <vector>

#include "harness/proxies/placed_solid.h"

namespace touchstone::proxies {

struct Overlap {
  double body = 0, parts = 0, both = 0;  // metres cubed
  double deviation = 0;                  // standard error of body + parts - 2 both
};

// Compares the union of `body` and of the interiors of `closed` (watertight triangles) with the
// union of `parts`. Lines along z form eight lattices of 4,096 points (Roberts' sequence of the
// plastic number), each shifted; lengths along a line are exact. The caller should rotate the
// solids so that they fill their box in x and y.
Overlap overlap_of(const std::vector<PlacedSolid>& body,
                   const std::vector<std::vector<geometry::Triangle>>& closed,
                   const std::vector<PlacedSolid>& parts);

}  // namespace touchstone::proxies
