// A body as a union of solids, for the measurement of proxies' errors.
#pragma once

#include <vector>

#include "harness/proxies/local_body.h"
#include "harness/proxies/placed_solid.h"

namespace touchstone::proxies {

// Solids in the local frame, rotated by `turn`. The body is the union of the convex ones and of what
// the closed surface winds around.
struct WholeBody {
  WholeBody(const LocalBody& body, const Mat3d& turn);

  std::vector<PlacedSolid> convex;          // hulls of open pieces, or a body without mesh
  std::vector<geometry::Triangle> closed;   // the closed pieces of a mesh
  std::vector<geometry::Triangle> surface;  // approximate if round
  double volume() const;                    // of a mesh as in union_volume.h
};

}  // namespace touchstone::proxies
