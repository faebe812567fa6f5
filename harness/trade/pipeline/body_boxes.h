// The boxes of a scene's bodies, frame by frame, as a configuration has them made.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "algorithms/broad_phase.h"
#include "harness/trade/pipeline/stand_ins.h"

namespace touchstone::trade {

class BodyBoxes {
 public:
  // All outlive it.
  BodyBoxes(const SceneFrames& frames, const StandIns& stand_ins, BoxChoice choice,
            Executor& executor);

  // The boxes of a frame from nothing; fat ones begin anew.
  void start(std::size_t frame);
  // The boxes of the next frame: bodies that never move keep theirs, fat boxes are kept
  // until the body leaves them. The boxes before stay valid, and those only.
  void advance(std::size_t frame);

  std::span<const Aabb> boxes() const { return boxes_[current_]; }
  FrameChange change() const { return {boxes(), moved_, inserted_, removed_}; }
  bool changed() const { return !moved_.empty() || !inserted_.empty() || !removed_.empty(); }
  std::int64_t computed() const { return computed_; }  // boxes, so far

 private:
  Aabb box_of(const SceneFrame& frame, std::uint32_t body) const;
  Aabb next_box(const SceneFrame& frame, std::uint32_t body, const Aabb& before) const;

  const SceneFrames* frames_;
  const StandIns* stand_ins_;
  BoxChoice choice_;
  Executor* executor_;
  std::vector<Aabb> boxes_[2];  // this frame's and the one before
  int current_ = 0;
  std::vector<std::uint32_t> moved_, inserted_, removed_;
  std::int64_t computed_ = 0;
};

}  // namespace touchstone::trade
