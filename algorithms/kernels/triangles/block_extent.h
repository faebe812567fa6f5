// Where the triangles of a block lie along one way: leaves of a fine mesh are nearly flat, so that along
// their normals others are seen to be apart whose boxes are not. Used by concave phases.
// Paper: Larsen, Gottschalk, Lin, Manocha, "Fast proximity queries with swept sphere volumes", UNC
//        TR99-018, 1999 (thin volumes at the leaves; there they are rectangles).
#pragma once

#include <array>

#include "algorithms/kernels/triangles/triangle_block.h"

namespace touchstone {

// A way, whose length is about 1, and the ends of a block along it (metres); NaN if a corner is not finite.
struct BlockExtent {
  Vec3d way;
  double low, high;
};

// Along the given way.
template <class Scalar>
BlockExtent extent_along(const TriangleBlockOf<Scalar>& block, const Vec3d& way);

// Along the sum of the triangles' normals; the way is zero if that is zero.
template <class Scalar>
BlockExtent extent_along_normal(const TriangleBlockOf<Scalar>& block);

// The ends of a block along each row of a matrix (metres); NaN if a corner is not finite.
struct BlockBox {
  std::array<double, 3> low, high;
};
template <class Scalar>
BlockBox box_along(const TriangleBlockOf<Scalar>& block, const Mat3d& ways);

// Returns the bits of the triangles that are not surely beyond the extent's ends by more than `slack`.
template <class Scalar>
unsigned reaching(const TriangleBlockOf<Scalar>& block, const BlockExtent& extent, double slack);

}  // namespace touchstone
