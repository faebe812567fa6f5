// Plays a scene frame by frame: poses, boxes, and what changed.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/broad_phase.h"
#include "harness/scene/kinematics.h"
#include "harness/scene/scene.h"

namespace touchstone::scene {

// Starts at frame 0. A scene gives the same bits each time and on every platform.
class ScenePlayer {
 public:
  ScenePlayer(const Scene& scene, BoxKind kind);

  int frame() const { return frame_; }
  // Advances to the next frame; false at the last one. The boxes of the previous frame stay valid,
  // but no earlier ones, as BroadPhase::update requires.
  bool next();

  std::span<const Pose> poses() const { return kinematics_.poses(); }  // empty for a recording
  // Finite boxes in world coordinates. A half-space's box is tight for both kinds, and its infinite
  // extents are cut to the region of all finite extents over all frames, so that no pair is lost. A
  // body that is not present has the empty box. If bodies arrive, the array grows at frame 1.
  std::span<const Aabb> boxes() const { return boxes_[current_]; }
  // Changes since the previous frame: `moved` lists every body whose box changed. Empty at frame 0.
  FrameChange change() const { return {boxes(), moved_, inserted_, removed_}; }

 private:
  Aabb box_of(std::size_t body) const;
  void list_changes(std::span<const Aabb> before, std::span<const Aabb> now);
  void fill_world();

  const Scene* scene_;
  BoxKind kind_;
  Kinematics kinematics_;
  int frame_ = 0;
  std::vector<double> reach_;   // for each body; loose boxes only
  Aabb world_ = Aabb::empty();  // the region to which half-spaces are cut
  std::vector<Aabb> boxes_[2];  // of this frame and the previous one
  int current_ = 0;
  std::vector<std::uint32_t> moved_, inserted_, removed_;
};

}  // namespace touchstone::scene
