// Used by all that is ODE's: the set-up of ODE's library, once a
// process, a lock for its globals, the conversion of a pose, and geoms of shapes. The calls of the
// broad phases run under the lock, and so do making and destroying geoms.
#pragma once

#include <ode/ode.h>

#include <memory>
#include <mutex>
#include <type_traits>

#include "algorithms/core/outcome.h"
#include "algorithms/core/pose.h"
#include "algorithms/core/shape.h"

namespace touchstone::ode {

// The scalar for which ODE is built.
inline constexpr Precision scalar =
    std::is_same_v<dReal, double> ? Precision::float64 : Precision::float32;

struct Library {
  std::mutex mutex;

  Library() { dInitODE2(0); }
};

// Locks ODE, and prepares it for this thread.
inline std::unique_lock<std::mutex> enter() {
  static Library library;
  std::unique_lock lock(library.mutex);
  dAllocateODEDataForThread(dAllocateMaskAll);
  return lock;
}

// A pose in ODE's layout: rows of four.
struct Placement {
  dVector3 position;
  dMatrix3 rotation;

  explicit Placement(const Pose& pose) {
    for (int row = 0; row < 3; ++row) {
      position[row] = static_cast<dReal>(pose.translation[row]);
      for (int column = 0; column < 3; ++column) {
        rotation[4 * row + column] = static_cast<dReal>(pose.rotation(row, column));
      }
      rotation[4 * row + 3] = 0;
    }
    position[3] = 0;
  }
};

struct DestroyGeom {
  void operator()(dGeomID geom) const {
    const auto lock = enter();
    dGeomDestroy(geom);
  }
};
using Geom = std::unique_ptr<std::remove_pointer_t<dGeomID>, DestroyGeom>;

// Makes the geom of a sphere, capsule, box or half-space, which has its place yet to come.
inline Geom make_geom(const Shape& shape) {
  const auto length = [](double half) { return static_cast<dReal>(2 * half); };
  const auto radius = static_cast<dReal>(shape.radius);
  const Vec3d& half = shape.half_extents;
  switch (shape.kind) {
    case ShapeKind::sphere: return Geom(dCreateSphere(nullptr, radius));
    case ShapeKind::capsule:
      return Geom(dCreateCapsule(nullptr, radius, length(shape.half_length)));
    case ShapeKind::box:
      return Geom(dCreateBox(nullptr, length(half.x()), length(half.y()), length(half.z())));
    case ShapeKind::halfspace: return Geom(dCreatePlane(nullptr, 0, 0, 1, 0));
    default: return nullptr;
  }
}

// Moves a geom; `shape` is its shape.
inline void place(dGeomID geom, const Shape& shape, const Pose& pose) {
  if (shape.kind == ShapeKind::halfspace) {
    const Vec3d normal = pose.rotation * shape.normal;
    const double offset = shape.offset + normal.dot(pose.translation);
    dGeomPlaneSetParams(geom, static_cast<dReal>(normal.x()), static_cast<dReal>(normal.y()),
                        static_cast<dReal>(normal.z()), static_cast<dReal>(offset));
    return;
  }
  const Placement placement(pose);
  dGeomSetPosition(geom, placement.position[0], placement.position[1], placement.position[2]);
  if (shape.kind != ShapeKind::sphere) dGeomSetRotation(geom, placement.rotation);
}

}  // namespace touchstone::ode
