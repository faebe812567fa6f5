// The pose of a body: its rotation and translation.
#pragma once

#include "algorithms/core/vec.h"

namespace touchstone {

// Maps body coordinates to world coordinates (metres): x -> rotation * x + translation. The
// rotation is used as given; nothing makes it orthonormal, so these bits state the exact problem.
struct Pose {
  Mat3d rotation = Mat3d::Identity();
  Vec3d translation = Vec3d::Zero();

  Vec3d operator()(const Vec3d& x) const { return rotation * x + translation; }
};

}  // namespace touchstone
