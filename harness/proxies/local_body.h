// A body where fitting is safe: about unit size, near the origin, with exact ways there and back.
#pragma once

#include <vector>

#include "harness/geometry/polyhedron.h"
#include "harness/proxies/representation.h"

namespace touchstone {

// The body is scaled by a power of two; a hull is also moved by exact differences: by one of its
// points along each axis where it is farther from the origin than it is long. So no digit of a body
// far off, tiny or huge is lost (numbers that become subnormal aside).
struct LocalBody {
  LocalBody(const Shape& body, const Mesh* mesh);

  Shape shape;
  std::vector<Vec3d> points;     // of hulls: the vertices, and the mesh's
  Mesh mesh;                     // empty for a body without one
  Vec3d middle = Vec3d::Zero();  // of the own axes' box
  Vec3d half = Vec3d::Zero();    // of the own axes' box, rounded up
  double size = 0;               // a bound on the distance of its points from the middle
  bool has_mesh = false;
  bool solid = true;  // of dimension 3

  // The nearest point at which a part can be centred exactly.
  Vec3d snap(const Vec3d& centre) const;
  // A part of this body's frame in the given one's. Its translation is a snapped point, or zero.
  Part placed(Part part) const;
  // Its inverse, up to rounding; metres of this frame as given.
  Part localised(Part part) const;
  double length_as_given(double length) const;

 private:
  Vec3d shift_ = Vec3d::Zero();  // as given
  int exponent_ = 0;
};

// The shape times 2^exponent.
Shape scaled(Shape shape, int exponent);

}  // namespace touchstone
