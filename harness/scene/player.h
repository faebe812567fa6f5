// Plays a scene frame by frame: poses, boxes, and what changed.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/broad_phase.h"
#include "harness/scene/kinematics.h"
#include "harness/scene/scene.h"

namespace touchstone {

// Starts at frame 0. The same scene gives the same bits each time it is played, on every platform.
class ScenePlayer {
 public:
  ScenePlayer(const Scene& scene, BoxKind kind);

  int frame() const { return frame_; }
  // Goes to the next frame; false at the last one. The boxes of the frame before stay valid (and
  // those only), as BroadPhase::update wants.
  bool next();

  std::span<const Pose> poses() const { return kinematics_.poses(); }  // empty for a recording
  // Finite boxes in world coordinates. A half-space's box is tight in either kind, and its infinite
  // extents are cut to the region that all finite extents fill over all frames, so that no pair is
  // lost. A body that is not there has the empty box; where bodies come and go, the array grows by
  // those that come first at frame 1.
  std::span<const Aabb> boxes() const { return boxes_[current_]; }
  // Against the frame before: moved lists every body whose box changed. Empty lists at frame 0.
  FrameChange change() const { return {boxes(), moved_, inserted_, removed_}; }

 private:
  Aabb box_of(std::size_t body) const;
  void list_changes(std::span<const Aabb> before, std::span<const Aabb> now);
  void fill_world();

  const Scene* scene_;
  BoxKind kind_;
  Kinematics kinematics_;
  int frame_ = 0;
  std::vector<double> reach_;   // of each body; loose boxes only
  Aabb world_ = Aabb::empty();  // what half-spaces are cut to
  std::vector<Aabb> boxes_[2];  // this frame's and the one before
  int current_ = 0;
  std::vector<std::uint32_t> moved_, inserted_, removed_;
};

}  // namespace touchstone
