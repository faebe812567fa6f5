// The shapes that a body can have.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "algorithms/core/vec.h"

namespace touchstone {

// The order matters: a batch of pairs has kind_a <= kind_b in this order.
enum class ShapeKind : std::uint8_t {
  sphere,
  capsule,
  box,
  cylinder,
  cone,
  ellipsoid,
  hull,
  halfspace,
};
inline constexpr std::array<ShapeKind, 8> all_shape_kinds = {
    ShapeKind::sphere, ShapeKind::capsule,   ShapeKind::box,  ShapeKind::cylinder,
    ShapeKind::cone,   ShapeKind::ellipsoid, ShapeKind::hull, ShapeKind::halfspace};

std::string_view to_string(ShapeKind kind);

// The convex hull of a set of points, in body coordinates (metres). A point, a segment and a flat
// set are hulls too.
struct Hull {
  // The boundary as polygons; empty unless dimension == 3. Coplanar facets are merged.
  struct Face {
    std::vector<std::uint32_t> loop;  // vertex indices, anticlockwise seen from outside
    Vec3d normal;                     // outward, unit length up to rounding
  };
  // Each undirected edge, listed once, with the two faces beside it: `left` has tail -> head in its
  // loop.
  struct Edge {
    std::uint32_t tail, head;
    std::uint32_t left, right;
  };

  std::vector<Vec3d> vertices;  // at least one; the convex hull of these is the body, literally
  int dimension = 3;            // 0 point, 1 segment, 2 flat, 3 solid
  std::vector<Face> faces;
  std::vector<Edge> edges;
  std::vector<std::vector<std::uint32_t>> neighbours;  // indexed by vertex; for climbing
};

// A convex shape in body coordinates. Only the fields of its kind have a meaning. Capsule, cylinder
// and cone lie along z; the body's pose gives them another axis.
struct Shape {
  ShapeKind kind = ShapeKind::sphere;
  double radius = 0;                   // sphere, capsule, cylinder, cone: metres, >= 0
  double half_length = 0;              // capsule: half of the straight part; cylinder; cone
                                       // (base at -half_length, tip at +half_length): metres, >= 0
  Vec3d half_extents = Vec3d::Zero();  // box: metres, >= 0
  Vec3d radii = Vec3d::Zero();         // ellipsoid: semi-axes in metres, >= 0
  std::shared_ptr<const Hull> hull;    // hull: never null
  Vec3d normal = Vec3d::UnitZ();       // half-space: points with normal . x <= offset;
  double offset = 0;                   // the normal is not zero and need not have unit length
};

}  // namespace touchstone
