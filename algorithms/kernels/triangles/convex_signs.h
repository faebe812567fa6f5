// Which of a block's triangles share a point with a convex shape, in doubles, a triangle a lane: every
// verdict is proven by a witness or by a separating direction, and what rounding leaves open is said.
// Papers: Ericson, "Real-Time Collision Detection", 2005, 5.1 (nearest points of segments and
//         triangles); Akenine-Moller, "Fast 3D triangle-box overlap testing", JGT 6(1), 2001 (the thirteen
//         axes); Snethen, "XenoCollide", Game Programming Gems 7, 2008 (portals, for hulls).
//
// Spheres and capsules: points of both that are less than the radius apart prove that they meet, a
// plane between them that they do not. Boxes: thirteen separating axes. Hulls: a support plane proves
// that they are apart, a tetrahedron of the portal search with the origin inside that they meet.
#pragma once

#include <vector>

#include "algorithms/core/shape.h"
#include "algorithms/kernels/triangles/triangle_block.h"

namespace touchstone {

// A convex shape as the lanes test it, in its own coordinates (metres).
struct LaneConvex {
  explicit LaneConvex(const Shape& shape);

  ShapeKind kind;
  double radius = 0;             // of the ball around the core, of spheres and capsules
  double half_length = 0;        // of a capsule; 0 of a sphere
  Vec3d low, high;               // the box around the core; infinite of a half-space
  double reach = 0;              // at least the magnitude of each finite coordinate of the core
  Vec3d centre = Vec3d::Zero();  // of a hull: a point of it, up to rounding
  std::vector<double> x, y, z;   // a hull's vertices
};

// Bits of a block's triangles: those that share a point with the shape, and those that are undecided.
struct LaneVerdicts {
  unsigned yes = 0, open = 0;
};

// Compares the triangles of the bits `wanted` with the shape. Each coordinate of the block, in the
// shape's frame, is off by at most `error` (metres). Shapes other than spheres, capsules, boxes and
// hulls are left open, unless their boxes are apart.
LaneVerdicts compare(const LaneConvex& convex, const TriangleBlock& block, unsigned wanted,
                     double error);

}  // namespace touchstone
