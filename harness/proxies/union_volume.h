// Volumes of unions of solids, by lines through them.
#pragma once

#include <vector>

#include "harness/proxies/placed_solid.h"

namespace touchstone {

struct Overlap {
  double body = 0, parts = 0, both = 0;  // metres cubed
  double deviation = 0;                  // standard error of body + parts - 2 both
};

// The union of `body` and of what each of `closed` (watertight triangles) winds around, against the
// union of `parts`. Lines along z stand on eight lattices of 4,096 points (Roberts' sequence of the
// plastic number), each shifted; along a line the lengths are exact. The solids fill their box in x
// and y best where the caller has turned them so.
Overlap overlap_of(const std::vector<PlacedSolid>& body,
                   const std::vector<std::vector<Triangle>>& closed,
                   const std::vector<PlacedSolid>& parts);

}  // namespace touchstone
