// The poses of a scene's bodies, frame by frame.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "harness/base/random.h"
#include "harness/scene/scene.h"

namespace touchstone {

// Starts at frame 0. Plain arithmetic only: the same bits on every platform. Each axis of a body's
// flight is exact for its velocity and acceleration; walls keep the energy. Attitudes are computed
// from frame 0's, so that no error adds up: rotation(frame) = exp(frame * time_step * w) *
// rotation.
//
// Then some of the bodies that move may exchange places, in a circle and at random, each with its
// own attitude and velocity; and some may go while as many come into the places left: at frame 1
// those that were never there, later those that went the frame before, each with its own shape. So
// places are spread as they were in any scene, and ids are used again.
class Kinematics {
 public:
  explicit Kinematics(const Scene& scene);

  int frame() const { return frame_; }
  void next();
  std::span<const Pose> poses() const { return poses_; }
  std::span<const Vec3d> velocities() const { return velocities_; }  // metres a second
  bool is_present(std::size_t body) const { return present_.empty() || present_[body] != 0; }

 private:
  void kick_some();
  void exchange_places(Random& random);
  void replace_some(Random& random);
  // Brings so many of movers_, picked at random, to its front, in random order.
  void pick_movers(Random& random, std::size_t count);

  const Scene* scene_;
  int frame_ = 0;
  std::vector<Pose> poses_;
  std::vector<Vec3d> velocities_;
  // Only where bodies come and go or jump.
  std::vector<std::uint32_t> movers_;  // that are present, in any order
  std::vector<std::uint32_t> absent_;
  std::vector<char> present_;  // of each body; only where bodies come and go
};

}  // namespace touchstone
