// The poses of a scene's bodies, frame by frame.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "harness/scene/scene.h"

namespace touchstone {

// Starts at frame 0. Plain arithmetic only: the same bits on every platform. Each axis of a body's
// flight is exact for its velocity and acceleration; walls keep the energy. Attitudes are computed
// from frame 0's, so that no error adds up: rotation(frame) = exp(frame * time_step * w) *
// rotation.
class Kinematics {
 public:
  explicit Kinematics(const Scene& scene);

  int frame() const { return frame_; }
  void next();
  std::span<const Pose> poses() const { return poses_; }
  std::span<const Vec3d> velocities() const { return velocities_; }  // metres a second

 private:
  void kick_some();

  const Scene* scene_;
  int frame_ = 0;
  std::vector<Pose> poses_;
  std::vector<Vec3d> velocities_;
};

}  // namespace touchstone
