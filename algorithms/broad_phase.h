// The contract of a broad phase: all pairs of boxes that overlap. Broad phases and the harness
// include this.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "algorithms/algorithm_info.h"
#include "algorithms/broad_phase_work.h"
#include "algorithms/core/aabb.h"
#include "algorithms/core/body_marks.h"
#include "algorithms/core/executor/executor.h"
#include "algorithms/core/pair_history.h"
#include "algorithms/core/pair_sink.h"
#include "algorithms/core/status.h"
#include "algorithms/core/structure_box.h"

namespace touchstone {

// The changes of a frame. `boxes` is the whole new array; a body's id is its place in it. The three
// lists are disjoint and in ascending order; a box in none of them has the bits of the last frame.
// The array grows when bodies with new ids come in, and never shrinks.
struct FrameChange {
  std::span<const Aabb> boxes;
  std::span<const std::uint32_t> moved;     // present before and now
  std::span<const std::uint32_t> inserted;  // not present before
  std::span<const std::uint32_t> removed;   // no longer present: boxes[id] is the empty box
};

// A broad phase is called as build, find_pairs, then (update, find_pairs) for each further frame;
// `build` may come again at any time and starts from scratch. The harness times the three
// separately. find_changes, find_pairs_of and find_changes_of may be called where find_pairs is.
//
// The boxes given to build or update stay alive and unchanged until the next build or update. Boxes
// are finite, with min <= max, or empty: an empty slot has no body and is skipped. There may be no
// boxes.
class BroadPhase {
 public:
  virtual ~BroadPhase() = default;

  virtual void build(std::span<const Aabb> boxes) = 0;
  virtual void update(const FrameChange& change) = 0;

  // Writes every pair of boxes whose closed boxes share a point, each once, a < b, in an order that
  // does not depend on the executor's width. No pair may be dropped: grow, or return
  // Status::capacity. Returns Status::ok otherwise.
  virtual Status find_pairs(PairSink& sink) = 0;

  // Writes the pairs that overlap now and did not at the last call, and those that did then and do
  // not any more; at the first call, all pairs have begun. Pairs are compared by their ids, over
  // builds too, and both lists ascend, so every broad phase writes the same. It is called instead
  // of find_pairs, or beside it; what changes in frames without a call is told by the next one. Its
  // own memory is not part of work(). Returns what find_pairs does; if that is not Status::ok,
  // nothing is written, and the next call compares with the last good one.
  //
  // A broad phase that does not override it finds all pairs, and compares.
  virtual Status find_changes(PairSink& began, PairSink& ended) {
    began.start(0);
    ended.start(0);
    const Status status = find_pairs(found_);
    if (status == Status::ok) told_.compare(found_, began, ended);
    return status;
  }

  // Writes the pairs of find_pairs of which one body, or both, is among these; the ids ascend, are
  // below the number of boxes, and may be of empty slots. Of the bodies that moved or came these
  // are the pairs with a box that is new. Of all that are neither static nor asleep they are what an
  // engine wants, to whom two bodies at rest are no pair. The conditions of find_pairs hold.
  //
  // A broad phase that does not override it finds all pairs, and drops the others.
  virtual Status find_pairs_of(std::span<const std::uint32_t> bodies, PairSink& sink) {
    const Status status = find_pairs(sink);
    if (status == Status::ok) {
      chosen_.set(bodies);
      chosen_.keep_pairs_of_marked(sink);
    }
    return status;
  }

  // Writes what find_changes does, of the pairs of find_pairs_of. A pair also begins when one of
  // its bodies joins the list, as one that wakes up, and ends when none is on it any more. What it
  // told before is apart from what find_changes told.
  Status find_changes_of(std::span<const std::uint32_t> bodies, PairSink& began, PairSink& ended) {
    began.start(0);
    ended.start(0);
    const Status status = find_pairs_of(bodies, found_);
    if (status == Status::ok) told_of_.compare(found_, began, ended);
    return status;
  }

  // Gives up what was built: only prepare or build may follow. A library frees it here; ours keep
  // their memory for the next build. The harness calls both before each build that it times, and
  // outside of the clock, so that a frame is not charged with the end of the one before.
  virtual void discard() {}
  // Makes what a build of so many boxes needs and does not depend on the boxes: a library's objects
  // and memory. It is a hint: build does without it.
  virtual void prepare(std::size_t /*slots*/) {}

  // Returns the work of find_pairs on the last build or update. It repeats the search to count, so
  // that find_pairs itself does not have to; the harness calls it outside of the timed region.
  virtual BroadPhaseWork work() const { return {}; }

  // Returns what it keeps of the last build or update, for pictures: boxes in world coordinates,
  // at levels from 0, the coarsest; structure_box.h says what these are. Cells and nodes without a
  // body are left out. Empty if it has nothing to show, as before the first build. It is not timed:
  // it may be slow, so that nothing has to be kept for it.
  virtual std::vector<StructureBox> structure() const { return {}; }

 private:
  PairSink found_;       // pairs of this frame, for the changes
  PairHistory told_;     // pairs of the last call of find_changes
  PairHistory told_of_;  // pairs of the last call of find_changes_of
  BodyMarks chosen_;     // scratch of find_pairs_of
};

// A broad phase of a library that has its own types for boxes.
class PeerBroadPhase : public BroadPhase {
 public:
  // Converts these boxes, none of them empty, to the library's types, in memory of its own. This
  // repeats what build and update do to new boxes, and nothing else, so that the harness can time
  // it separately.
  virtual void convert(std::span<const Aabb> boxes) = 0;
};

struct BroadPhaseEntry {
  AlgorithmInfo info;
  // Null if it is not built. The executor outlives the algorithm.
  std::function<std::unique_ptr<BroadPhase>(Executor&)> make;
};

}  // namespace touchstone
