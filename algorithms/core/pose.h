// Where a body stands.
#pragma once

#include "algorithms/core/vec.h"

namespace touchstone {

// Maps body coordinates to the world's (metres): x -> rotation * x + translation.
// The rotation is used as it stands; nothing re-orthonormalises it, so the exact problem is the one
// that these bits state.
struct Pose {
  Mat3d rotation = Mat3d::Identity();
  Vec3d translation = Vec3d::Zero();

  Vec3d operator()(const Vec3d& x) const { return rotation * x + translation; }
};

}  // namespace touchstone
