// The input of a block's algorithms: all frames at once, so that any window can be timed.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "algorithms/broad_phase.h"
#include "algorithms/core/pose.h"
#include "harness/grade/pair_groups.h"
#include "harness/scene/scene.h"

namespace touchstone::measure {

struct BlockFrame {
  std::vector<Aabb> boxes;
  std::vector<std::uint32_t> moved, inserted, removed;  // changes against the frame before
  std::vector<Pose> poses;                              // empty unless a narrow phase needs them
  std::vector<IndexPair> truth;  // sorted: the overlapping boxes, or the pairs that the scene lists

  FrameChange change() const { return {boxes, moved, inserted, removed}; }
};

struct BlockInput {
  // Plays the scene. The true pairs are those of overlapping_pairs, unless the scene lists its
  // pairs.
  BlockInput(const scene::Scene& scene, scene::BoxKind kind, bool with_poses);

  std::span<const Shape> shapes;  // the scene's shapes
  std::vector<std::uint32_t> shape_of;
  std::vector<BlockFrame> frames;
};

// The pairs of one kind that one source finds; narrow phases solve them together.
struct NarrowSet {
  std::string broad;  // the broad phase that found the pairs; empty for the true ones
  Task task;
  ShapeKind kind_a, kind_b;
  std::vector<grade::PairGroup> frames;  // one group for each frame, possibly without pairs

  std::string kind_name() const;
  std::size_t pairs() const;  // the number over all frames
};

// Returns one set for each task and kind of pairs that occurs; `pairs` holds those of each frame.
std::vector<NarrowSet> narrow_sets(const BlockInput& input, const std::string& broad,
                                   std::span<const std::vector<IndexPair>> pairs,
                                   std::span<const Task> tasks);

}  // namespace touchstone::measure
