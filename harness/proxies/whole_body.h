// A body as the solids that it is made of.
#pragma once

#include <vector>

#include "harness/proxies/local_body.h"
#include "harness/proxies/placed_solid.h"

namespace touchstone {

// In the local frame, turned. The body is the union of all.
struct WholeBody {
  WholeBody(const LocalBody& body, const Mat3d& turn);

  std::vector<PlacedSolid> convex;  // hulls of pieces that are not closed; a body without mesh
  std::vector<std::vector<Triangle>> closed;  // pieces of a mesh that are
  std::vector<Triangle> surface;              // of a round shape near it
  double volume() const;                      // of a mesh as in union_volume.h
};

}  // namespace touchstone
