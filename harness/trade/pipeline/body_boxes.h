// The boxes of a scene's bodies, frame by frame, of the kind that a configuration chooses.
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
  // All arguments outlive it.
  BodyBoxes(const SceneFrames& frames, const StandIns& stand_ins, BoxChoice choice,
            Executor& executor);

  // Computes the boxes of a frame from nothing; fat ones begin anew.
  void start(std::size_t frame);
  // Computes the boxes of the next frame: bodies that never move keep theirs, and fat boxes are
  // kept until the body leaves them. The boxes of the frame before stay valid, but no earlier ones.
  void advance(std::size_t frame);

  std::span<const Aabb> boxes() const { return boxes_[current_]; }
  FrameChange change() const { return {boxes(), moved_, inserted_, removed_}; }
  bool changed() const { return !moved_.empty() || !inserted_.empty() || !removed_.empty(); }
  std::int64_t computed() const { return computed_; }  // the number of boxes so far

 private:
  Aabb box_of(const SceneFrame& frame, std::uint32_t body) const;
  Aabb next_box(const SceneFrame& frame, std::uint32_t body, const Aabb& before) const;

  const SceneFrames* frames_;
  const StandIns* stand_ins_;
  BoxChoice choice_;
  Executor* executor_;
  std::vector<Aabb> boxes_[2];  // those of this frame and of the one before
  int current_ = 0;
  std::vector<std::uint32_t> moved_, inserted_, removed_;
  std::int64_t computed_ = 0;
};

}  // namespace touchstone::trade
