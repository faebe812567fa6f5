// A shape as a core with a ball around it, prepared for support maps once per scene. Used by every
// narrow phase with support maps.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/core/shape.h"
#include "algorithms/kernels/minkowski/hull_scan.h"
#include "algorithms/kernels/minkowski/support_cube_map.h"

namespace touchstone {

enum class SupportCore : std::uint8_t {
  point,
  segment,
  box,
  cylinder,
  cone,
  ellipsoid,
  hull,
  halfspace
};

// The prepared shape for one scalar type. The core is stored relative to `centre` and divided by
// the power of two `unit`, so that its coordinates are at most 1.
template <class Scalar>
struct SupportShape {
  using Core = SupportCore;

  explicit SupportShape(const Shape& shape);

  Core core = Core::point;
  double unit = 1;             // metres
  double size = 0;             // metres: the core's greatest distance from the centre
  double radius = 0;           // metres: radius of the ball around the core
  bool is_centred = true;      // the centre is the body's origin
  bool is_near_origin = true;  // no component of the centre exceeds the size
  Vec3d centre =
      Vec3d::Zero();  // body coordinates: inside the shape (its relative interior if it is flat)
  // Box: half extents; ellipsoid: semi-axes; segment, cylinder, cone: radius, radius, half length.
  Vec3<Scalar> extents = Vec3<Scalar>::Zero();
  // Hull: its vertices for a scan, or, if there are many, their cube map `cells`.
  std::vector<hull_scan::VertexBlock<Scalar>> vertices;
  SupportCubeMap<Scalar> cells;
  // In double: the vertices as floats, if there are so many that floats pay.
  std::vector<hull_scan::VertexBlock<float>> rough;
  // The vertices once more, one after the other, for access to a single one.
  struct alignas(4 * sizeof(Scalar)) Corner {
    Scalar x, y, z;
  };
  std::vector<Corner> corners;
  // Half-space: as in Shape.
  Vec3d normal = Vec3d::UnitZ();
  double offset = 0;

  // Extent of the rotated body from its centre (metres), within a factor of two.
  double reach(const Mat3d& rotation) const {
    return size * rotation.cwiseAbs().maxCoeff() + radius;
  }
  // Hull: the index of the vertex that is furthest in the direction.
  std::uint32_t furthest(const Vec3<Scalar>& direction) const {
    if (!cells.empty()) return cells.number(cells.furthest(direction).place);
    return hull_scan::furthest(scanned_hull(), direction);
  }
  // Hull without a cube map.
  hull_scan::ScannedHull<Scalar> scanned_hull() const {
    return {vertices, rough.empty() ? nullptr : rough.data()};
  }
  Vec3<Scalar> vertex(std::uint32_t i) const {
    const Corner& corner = corners[i];
    return {corner.x, corner.y, corner.z};
  }
  // Like `vertex`, for a hull without a cube map; faster directly after a scan.
  Vec3<Scalar> scanned_vertex(std::uint32_t i) const {
    constexpr std::uint32_t lanes = hull_scan::VertexBlock<Scalar>::size;
    return vertices[i / lanes].vertex(i % lanes);
  }
  bool is_polytope() const { return core <= Core::box || core == Core::hull; }
  bool is_smooth() const { return core == Core::point || core == Core::ellipsoid; }
};

template <class Scalar>
std::vector<SupportShape<Scalar>> make_support_shapes(std::span<const Shape> shapes);

// The least power of two above a length, so that length / result is in [1/2, 1).
// Clamped so that the result and its inverse are normal numbers; the least of these for zero.
inline double power_of_two_above(double length) {
  // The exponent field, read from the bits: the callers need no more precision.
  const auto field = static_cast<int>(std::bit_cast<std::uint64_t>(length) >> 52 & 0x7ff);
  const int exponent = std::clamp(field + 1, 64, 1982);
  return std::bit_cast<double>(static_cast<std::uint64_t>(exponent) << 52);
}

}  // namespace touchstone
