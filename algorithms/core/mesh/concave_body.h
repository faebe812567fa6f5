// Bodies that need not be convex: a mesh, or convex parts. Everything may include this.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "algorithms/core/mesh/triangle_mesh.h"
#include "algorithms/core/pose.h"
#include "algorithms/core/shape.h"

namespace touchstone {

// A convex shape and its place in its body.
struct ConvexPart {
  Shape shape;
  Pose pose;  // from the shape's coordinates to the body's
  // A bound in metres on the distance by which any of the part's points is off because compounds
  // within compounds were placed in doubles; 0 if nothing was rounded.
  double rounding = 0;
};

// The union of its parts: the triangles of a mesh, in their order, or convex parts, which a
// compound numbers depth first. A convex body is a compound of one part. A body may have no part;
// it shares no point with anything.
struct ConcaveBody {
  std::shared_ptr<const TriangleMesh> mesh;  // null: the body has convex parts
  std::vector<ConvexPart> parts;             // empty if there is a mesh

  std::uint32_t part_count() const {
    return static_cast<std::uint32_t>(mesh ? mesh->triangles.size() : parts.size());
  }
};

}  // namespace touchstone
