// Meshes for tests.
#pragma once

#include <vector>

#include "algorithms/core/mesh/concave_body.h"
#include "harness/families/meshes.h"
#include "tests/algorithms/concave/phases.h"
#include "tests/algorithms/shapes.h"

namespace touchstone::reference {

inline ConcaveBody body_of(TriangleMesh mesh) {
  return {std::make_shared<const TriangleMesh>(std::move(mesh)), {}};
}
inline ConcaveBody body_of(Shape shape, Pose pose = {}) { return {nullptr, {{shape, pose, 0}}}; }

using families::box_mesh;
using families::torus;

inline Pose moved_by(const Vec3d& translation) { return {Mat3d::Identity(), translation}; }

}  // namespace touchstone::reference
