// Our shapes and poses as FCL's.
#pragma once

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/sphere.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <tuple>
#include <vector>

#include "algorithms/core/pose.h"
#include "algorithms/core/shape.h"
#include "algorithms/encoding.h"

namespace touchstone::fcl_shapes {

// FCL's shapes in the order of ShapeKind.
template <class S>
using FclShapes = std::tuple<fcl::Sphere<S>, fcl::Capsule<S>, fcl::Box<S>, fcl::Cylinder<S>,
                             fcl::Cone<S>, fcl::Ellipsoid<S>, fcl::Convex<S>, fcl::Halfspace<S>>;
template <class S, ShapeKind kind>
using FclShape = std::tuple_element_t<static_cast<std::size_t>(kind), FclShapes<S>>;

template <class S>
std::unique_ptr<fcl::Convex<S>> make_convex(const Hull& hull) {
  auto vertices = std::make_shared<std::vector<Vec3<S>>>();
  for (const Vec3d& vertex : hull.vertices) vertices->push_back(vertex.cast<S>());
  // Each face is its count and then its vertices.
  auto faces = std::make_shared<std::vector<int>>();
  for (const Hull::Face& face : hull.faces) {
    faces->push_back(static_cast<int>(face.loop.size()));
    for (const std::uint32_t vertex : face.loop) faces->push_back(static_cast<int>(vertex));
  }
  return std::make_unique<fcl::Convex<S>>(vertices, static_cast<int>(hull.faces.size()), faces);
}

template <class S>
std::unique_ptr<fcl::ShapeBase<S>> make_fcl_shape(const Shape& shape) {
  const S radius = static_cast<S>(shape.radius);
  const S length = static_cast<S>(2 * shape.half_length);
  switch (shape.kind) {
    case ShapeKind::sphere: return std::make_unique<fcl::Sphere<S>>(radius);
    case ShapeKind::capsule: return std::make_unique<fcl::Capsule<S>>(radius, length);
    case ShapeKind::box:
      return std::make_unique<fcl::Box<S>>(Vec3<S>((2 * shape.half_extents).cast<S>()));
    case ShapeKind::cylinder: return std::make_unique<fcl::Cylinder<S>>(radius, length);
    case ShapeKind::cone: return std::make_unique<fcl::Cone<S>>(radius, length);
    case ShapeKind::ellipsoid:
      return std::make_unique<fcl::Ellipsoid<S>>(Vec3<S>(shape.radii.cast<S>()));
    case ShapeKind::hull: return make_convex<S>(*shape.hull);
    case ShapeKind::halfspace: {
      const UnitHalfspace unit(shape);
      return std::make_unique<fcl::Halfspace<S>>(Vec3<S>(unit.normal.cast<S>()),
                                                 static_cast<S>(unit.offset));
    }
  }
  return nullptr;
}

template <class S>
fcl::Transform3<S> to_fcl(const Pose& pose) {
  fcl::Transform3<S> transform;
  transform.linear() = pose.rotation.cast<S>();
  transform.translation() = pose.translation.cast<S>();
  transform.makeAffine();
  return transform;
}

}  // namespace touchstone::fcl_shapes
