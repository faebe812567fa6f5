// Bodies that need not be convex: a mesh, or convex parts. Everything may include this.
#pragma once

#include <algorithm>
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
  // If that is not 0: the poses whose product `pose` is, the outermost first, where they are known.
  std::shared_ptr<const std::vector<Pose>> poses = nullptr;
};

// A mesh within a compound. Its triangles are parts of the compound, each a flat hull, all with one
// pose.
struct CompoundSurface {
  // If it is solid, the points around which it winds belong to the body too.
  std::shared_ptr<const TriangleMesh> mesh;
  std::uint32_t first = 0;  // the part that is its first triangle; the others follow in their order
};

// The union of its parts: the triangles of a mesh, in their order, or convex parts, which a
// compound numbers depth first; and of what solid meshes wind around. A convex body is a compound of one
// part. A body may have no part; it shares no point with anything.
struct ConcaveBody {
  std::shared_ptr<const TriangleMesh> mesh;  // null: the body has convex parts
  std::vector<ConvexPart> parts;             // empty if there is a mesh
  std::vector<CompoundSurface> surfaces =
      {};  // of a compound, in the order of their parts; none is empty

  std::uint32_t part_count() const {
    return static_cast<std::uint32_t>(mesh ? mesh->triangles.size() : parts.size());
  }
  // True if points belong to the body that are in none of its parts.
  bool has_inside() const {
    return (mesh && mesh->solid) ||
           std::ranges::any_of(surfaces, [](const CompoundSurface& s) { return s.mesh->solid; });
  }
};

}  // namespace touchstone
