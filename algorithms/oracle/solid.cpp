// Makes a solid from each kind of shape.
#include "algorithms/oracle/solid.h"

#include <algorithm>
#include <cmath>

#include "algorithms/oracle/numbers/dyadic.h"

namespace touchstone::oracle {
Solid::Solid(const Shape& shape) {
  const Vec3d axis(0, 0, shape.half_length);
  switch (shape.kind) {
    case ShapeKind::sphere:
      vertices = {Vec3d::Zero()};
      radius = shape.radius;
      break;
    case ShapeKind::capsule:
      vertices = {-axis, axis};
      radius = shape.radius;
      break;
    case ShapeKind::box:
      is_box = true;
      for (int i = 0; i < 8; ++i) {
        const Vec3d& h = shape.half_extents;
        vertices.emplace_back(i & 1 ? h.x() : -h.x(), i & 2 ? h.y() : -h.y(),
                              i & 4 ? h.z() : -h.z());
      }
      break;
    case ShapeKind::cylinder:
    case ShapeKind::cone:
      extents = {shape.radius, shape.radius, shape.half_length};
      // A cone without height is a disc, like a cylinder without height.
      core = shape.kind == ShapeKind::cone && shape.half_length > 0 ? Core::cone : Core::cylinder;
      if (shape.radius == 0) {
        core = Core::polytope;
        vertices = {-axis, axis};
      }
      break;
    case ShapeKind::ellipsoid:
      extents = shape.radii;
      core = Core::ellipsoid;
      if ((extents.array() == 0).count() >= 2) {
        core = Core::polytope;
        vertices = {-extents, extents};
      }
      break;
    case ShapeKind::hull: vertices = shape.hull->vertices; break;
    case ShapeKind::halfspace:
      core = Core::halfspace;
      normal = shape.normal;
      offset = shape.offset;
      break;
  }
  Vec3d greatest = extents;
  for (const Vec3d& v : vertices) greatest = greatest.cwiseMax(v.cwiseAbs());
  std::frexp(greatest.maxCoeff(), &exponent);
  for (int k = 0; k < 3; ++k) {
    if (is_curved()) {
      // The grid gives a coordinate 63 bits, at least as many as the extent itself has.
      if (extents[k] > 0) grid[k] = std::ilogb(extents[k]) - 62;
      continue;
    }
    grid[k] = Dyadic::of_zero;
    for (const Vec3d& v : vertices) grid[k] = std::min(grid[k], dyadic(v[k]).exponent);
    if (grid[k] == Dyadic::of_zero) grid[k] = 0;
  }
  for (const Vec3d& v : vertices) {
    x.push_back(std::ldexp(v.x(), -exponent));
    y.push_back(std::ldexp(v.y(), -exponent));
    z.push_back(std::ldexp(v.z(), -exponent));
  }
}

}  // namespace touchstone::oracle
