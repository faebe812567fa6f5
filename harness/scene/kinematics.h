// The poses of a scene's bodies, frame by frame, and its steps as motions: where bodies are in a
// frame, and how they get to the next.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "algorithms/core/motion.h"
#include "algorithms/core/pose.h"
#include "harness/base/random.h"
#include "harness/scene/scene.h"

namespace touchstone::scene {

// Starts at frame 0. Uses plain arithmetic only, which gives the same bits on every platform. Each
// axis of a body's flight is exact for its velocity and acceleration; walls preserve the energy.
// Orientations are computed from frame 0, so that no error accumulates: rotation(frame) = exp(frame
// * time_step * w) * rotation.
//
// Bodies with tracks are at their poses, and their velocities are those of the step that led there.
//
// Afterwards some of the other moving bodies may exchange places, in a random cycle, each with its own
// orientation and velocity. Some may leave while as many arrive in their places: at frame 1 those
// that were never present, later those that left in the previous frame, each with its own shape. So
// the distribution of places stays that of the scene, and ids are reused.
class Kinematics {
 public:
  explicit Kinematics(const Scene& scene);

  int frame() const { return frame_; }
  void next();
  std::span<const Pose> poses() const { return poses_; }
  std::span<const Vec3d> velocities() const { return velocities_; }  // metres per second
  bool is_present(std::size_t body) const { return present_.empty() || present_[body] != 0; }

 private:
  void kick_some();
  void follow_tracks();
  void exchange_places(base::Random& random);
  void replace_some(base::Random& random);
  // Moves `count` random elements of movers_ to its front, in random order.
  void pick_movers(base::Random& random, std::size_t count);

  const Scene* scene_;
  int frame_ = 0;
  std::vector<Pose> poses_;
  std::vector<Vec3d> velocities_;
  // The members below are used only if bodies jump, arrive or leave.
  std::vector<std::uint32_t> movers_;  // present bodies that move, in any order
  std::vector<std::uint32_t> absent_;
  std::vector<char> present_;  // for each body; only if bodies arrive and leave
};

// A body of the scene has the same index in both lists.
struct MotionStep {
  std::vector<Pose> poses;  // in the frame
  std::vector<touchstone::Motion> motions;
};

// Returns a step for each frame, from it to the next: as many steps as the scene has frames. In a
// step a body goes straight to its place in the next frame, also where that is on a curve or behind a
// wall's reflection, and turns evenly by its angular velocity. On a track it turns by the least turn that leads to its
// next attitude, up to the last bits of this machine's arc tangent; the last step leaves it where it is. Throws
// InputError with the name of the file if the scene has no bodies, or if they jump, arrive or leave.
std::vector<MotionStep> motion_steps(const Scene& scene, const std::filesystem::path& file);

}  // namespace touchstone::scene
