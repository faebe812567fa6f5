// A convex shape against triangles in lanes: the bounds on rounding, and the choice of the instruction
// level.
//
// u is half an epsilon, M the greatest magnitude of a coordinate of the triangle and the shape, and
// `error` bounds by how much a coordinate is off. An axis is any direction in doubles; |axis| is the
// sum of its magnitudes. A product axis . p is off by |axis| error and 3 u |axis| M, the half extent
// of a shape along it likewise, and their difference by 4 u |axis| M: together less than
//     |axis| (error + 16 u M)   <   |axis| slack,   slack = 4 error + 64 u M.
// So a gap above |axis| slack separates, whatever the axis is.
//
// A box and a triangle that overlap by more than the rounding along all of their thirteen axes meet:
// let T be the triangle of the rounded corners. If the true triangle, whose corners are nearer than
// sqrt(3) error to those of T, missed the box, the boxes' planes would part along one of T's axes
// but for 2 error |axis|. A difference of corners is right up to u of itself, so cross products
// of an edge and a unit vector are as good as given axes, and an edge along the unit vector has no
// axis. The triangle's normal is off by 8 u E^2 in each component (E: the longest edge's component), so
// that what is computed along it is off by 24 u E^2 M more.
//
// Nearest points are means of corners with weights in [0, 1], off by error and 8 u M in each
// coordinate. That their weights may be the wrong ones is no matter: a witness proves, or the
// plane through it does, or the lane stays open.
//
// A corner of the hulls' difference is off by error + 2 u M in each coordinate, the centre by less than
// error + 16 u M. Volumes of three such vectors are off as in triangle_signs.cpp.
//
// Below 1e-140 squares underflow; a constant in each bound leaves such lanes open. NaN and infinity
// compare so that they stay open too.
#include "algorithms/kernels/triangles/convex_signs.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "algorithms/core/bounds.h"
#include "algorithms/kernels/simd/vector.h"

namespace touchstone {
namespace {

constexpr double u = std::numeric_limits<double>::epsilon() / 2;
constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double underflow = 1e-280;
// The portal search is given up after that many supports: nearly all that meet by more than a
// millionth of the size end sooner.
constexpr int most_supports = 24;

#define TOUCHSTONE_TARGET_INCLUDE "algorithms/kernels/triangles/convex_signs.inl"
#include "algorithms/kernels/simd/foreach_target.inl"

}  // namespace

LaneConvex::LaneConvex(const Shape& shape) : kind(shape.kind) {
  switch (kind) {
    case ShapeKind::sphere: radius = shape.radius; break;
    case ShapeKind::capsule:
      radius = shape.radius;
      half_length = shape.half_length;
      break;
    default: break;
  }
  if (kind == ShapeKind::sphere || kind == ShapeKind::capsule) {
    low = {0, 0, -half_length};
    high = {0, 0, half_length};
  } else if (kind == ShapeKind::box) {
    low = -shape.half_extents;
    high = shape.half_extents;
  } else {
    const Aabb box = tight_box(shape, Pose{});
    for (int k = 0; k < 3; ++k) {
      low[k] = box.min[static_cast<std::size_t>(k)];
      high[k] = box.max[static_cast<std::size_t>(k)];
    }
  }
  for (int k = 0; k < 3; ++k) {
    for (const double at : {low[k], high[k]}) {
      if (std::isfinite(at)) reach = std::max(reach, std::abs(at));
    }
  }
  if (kind != ShapeKind::hull) return;
  for (const Vec3d& vertex : shape.hull->vertices) {
    x.push_back(vertex[0]);
    y.push_back(vertex[1]);
    z.push_back(vertex[2]);
    centre += vertex / static_cast<double>(shape.hull->vertices.size());
  }
}

LaneVerdicts compare(const LaneConvex& convex, const TriangleBlock& block, unsigned wanted,
                     double error) {
  switch (isa()) {
    case Isa::avx512: return avx512::compare_block(convex, block, wanted, error);
    case Isa::avx2: return avx2::compare_block(convex, block, wanted, error);
    case Isa::baseline: break;
  }
  return baseline::compare_block(convex, block, wanted, error);
}

}  // namespace touchstone
