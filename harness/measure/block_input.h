// The input of a block's algorithms: all frames at once, so that any window can be timed, with the
// true pairs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "algorithms/broad_phase.h"
#include "algorithms/core/aabb.h"
#include "algorithms/core/pair_sink.h"
#include "algorithms/core/pose.h"
#include "harness/grade/pair_groups.h"
#include "harness/record/query_task.h"
#include "harness/scene/scene.h"

namespace touchstone::measure {

// The pairs of boxes that overlap, found by the harness itself: the reference for broad phases.

// The largest number of boxes for which the naive broad phase tests every pair; with more boxes,
// which would take minutes, a tree excludes those that are certainly apart.
inline constexpr std::size_t most_boxes_to_test_all = 30'000;

// Returns the pairs sorted, a < b, each once. Empty boxes have no pairs. It runs in the caller's
// thread.
std::vector<IndexPair> overlapping_pairs(std::span<const Aabb> boxes,
                                         std::size_t most_to_test_all = most_boxes_to_test_all);

struct BlockFrame {
  std::vector<Aabb> boxes;
  std::vector<std::uint32_t> moved, inserted, removed;  // changes against the frame before
  std::vector<Pose> poses;                              // empty unless a narrow phase needs them
  std::vector<IndexPair> truth;  // sorted: the overlapping boxes, or the pairs that the scene lists

  FrameChange change() const { return {boxes, moved, inserted, removed}; }
};

// The bodies of all shapes, convex ones as compounds of one part.
std::vector<ConcaveBody> concave_bodies(const scene::Scene& scene);

struct BlockInput {
  // Plays the scene. The true pairs are those of overlapping_pairs, unless the scene lists its
  // pairs.
  BlockInput(const scene::Scene& scene, scene::BoxKind kind, bool with_poses);

  bool is_concave(std::uint32_t body) const {
    return !kinds.empty() && !kinds[shape_of[body]].empty();
  }

  std::span<const Shape> shapes;  // the scene's shapes
  // In a scene with bodies that are not convex, those of all shapes, convex ones as one part each,
  // and the kinds of those that are not: "mesh", "solid" or "compound"; "" for convex ones.
  std::vector<ConcaveBody> bodies;
  std::vector<std::string_view> kinds;
  std::vector<std::uint32_t> shape_of;
  std::vector<BlockFrame> frames;
  scene::PairFilter filter;  // of the pairs for narrow phases
};

// The pairs of one kind that one source finds; narrow phases or concave phases solve them together.
struct NarrowSet {
  std::string broad;  // the broad phase that found the pairs; empty for the true ones
  record::QueryTask task;
  ShapeKind kind_a, kind_b;              // of the shapes; of concave pairs: those of the first one
  std::vector<grade::PairGroup> frames;  // one group for each frame, possibly without pairs
  // Of pairs with a body that is not convex, which are for concave phases: "box-mesh". The kinds are
  // in alphabetical order, and so are the bodies of a pair.
  std::string concave_kind = {};

  bool is_concave() const { return !concave_kind.empty(); }

  std::string kind_name() const;
  std::size_t pairs() const;  // the number over all frames
};

// Returns one set for each kind of pairs that occurs and task that phases for such pairs may have;
// `pairs` holds those of each frame, of which the scene's filter leaves out some.
std::vector<NarrowSet> narrow_sets(const BlockInput& input, const std::string& broad,
                                   std::span<const std::vector<IndexPair>> pairs,
                                   std::span<const record::QueryTask> tasks);

}  // namespace touchstone::measure
