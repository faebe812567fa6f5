// A body in a frame where fitting is safe: about unit size, near the origin, with exact
// conversions.
#pragma once

#include <limits>
#include <vector>

#include "harness/geometry/polyhedron.h"
#include "harness/proxies/representation.h"

namespace touchstone::proxies {

inline constexpr double epsilon = std::numeric_limits<double>::epsilon();
inline constexpr double infinity = std::numeric_limits<double>::infinity();

// The body is scaled by a power of two. A hull is also moved by exact differences: by one of its
// points along each axis on which it is farther from the origin than it is long. So no digit of a
// distant, tiny or huge body is lost (except for subnormal numbers).
struct LocalBody {
  LocalBody(const Shape& body, const geometry::Mesh* mesh);

  Shape shape;
  std::vector<Vec3d> points;     // of hulls: the vertices, and those of the mesh
  geometry::Mesh mesh;           // empty if the body has none
  Vec3d middle = Vec3d::Zero();  // centre of the box along the body's axes
  Vec3d half = Vec3d::Zero();    // half extents of that box, rounded up
  double size = 0;               // upper bound on the distance of its points from the middle
  bool has_mesh = false;
  bool solid = true;  // has dimension 3

  // The point nearest to `centre` at which a part can be centred exactly.
  Vec3d snap(const Vec3d& centre) const;
  // Converts a part to the original frame. Its translation must be a snapped point, or zero.
  Part placed(Part part) const;
  // The inverse of `placed`, up to rounding, and the original length of a length here in metres.
  Part localised(Part part) const;
  double length_as_given(double length) const;

 private:
  Vec3d shift_ = Vec3d::Zero();  // in the original frame
  int exponent_ = 0;
};

// The shape times 2^exponent.
Shape scaled(Shape shape, int exponent);

}  // namespace touchstone::proxies
