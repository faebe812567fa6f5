#include "algorithms/oracle/solid.h"

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
      for (int i = 0; i < 8; ++i) {
        const Vec3d& h = shape.half_extents;
        vertices.emplace_back(i & 1 ? h.x() : -h.x(), i & 2 ? h.y() : -h.y(),
                              i & 4 ? h.z() : -h.z());
      }
      break;
    case ShapeKind::cylinder:
    case ShapeKind::cone:
      extents = {shape.radius, shape.radius, shape.half_length};
      core = shape.kind == ShapeKind::cone ? Core::cone : Core::cylinder;
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
}

}  // namespace touchstone::oracle
