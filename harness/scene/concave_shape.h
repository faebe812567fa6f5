// Shapes of bodies that are not convex, with the hull that stands for them.
#pragma once

#include <memory>
#include <vector>

#include "algorithms/core/aabb.h"
#include "algorithms/core/mesh/concave_body.h"
#include "algorithms/core/shape.h"
#include "harness/geometry/mesh.h"
#include "harness/geometry/shapes/mesh_body.h"

namespace touchstone::scene {

using geometry::MeshUse;

struct ConcaveShape {
  Shape hull;
  std::shared_ptr<const geometry::Mesh> mesh;
  std::shared_ptr<const ConcaveBody> body;  // null: the hull is the body
};

ConcaveShape mesh_shape(geometry::Mesh mesh, MeshUse use);
// `body` is a compound.
ConcaveShape compound_shape(ConcaveBody body);

// The tight box of a body that has triangles or parts, rounded outward.
Aabb concave_box(const ConcaveBody& body, const Shape& hull, const Pose& pose);
// As loose_reach.
double concave_reach(const ConcaveBody& body, const Shape& hull, const Mat3d& rotation);

}  // namespace touchstone::scene
