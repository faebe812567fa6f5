// Sweep and prune: keep the boxes' end points sorted on three axes from frame to frame, and a set of
// pairs that changes only when a minimum and a maximum pass each other.
// Paper:   Baraff, "Dynamic Simulation of Non-Penetrating Rigid Bodies", thesis, Cornell 1992;
//          Cohen, Lin, Manocha, Ponamgi, "I-COLLIDE", I3D 1995.
// Steps:   1. Radix-sort the end points on three axes, and sweep the axis with the fewest overlaps
//             for all pairs (endpoint_list.cpp, kernels/boxes/aabb_scan.h).
//          2. In an update take bodies that come, go or move far out of the end points and the
//             pairs.
//          3. Update the end points of the other moved bodies on each axis by insertion sort, and
//             test the boxes of each minimum and maximum that pass each other
//             (endpoint_list_update.cpp).
//          4. Insert the pairs that came and erase those that went, axis by axis (pair_set.h).
//          5. Merge the bodies of step 2 back in, and test each against all boxes.
//          6. If too many end points pass each other, start at step 1; then sort and sweep only one
//             axis for 1, 3, 7 or 15 frames, more with each failure.
//          7. Copy the pairs out, or those that came or went since changes were last asked for.
// Departs: the three axes are updated concurrently, each for the bodies that moved along it, see
//          endpoint_list.h. Bodies that come, go or move far are merged into the end points in one
//          pass, and tested against all boxes a vector at a time. When the end points pass each
//          other more often than a sweep of the best axis would cost, they are sorted from scratch.
// Fails:   dense or fast scenes in which all bodies move: an end point passes others in proportion
//          to n^(2/3) times its displacement, and in flat or stacked scenes to n. The sweep that is
//          then made grows like n^(5/3), and n^2 where most boxes overlap on every axis.
// Cost:    O(m + s) a frame, for m bodies that move and s end points that pass each other; O(n + k)
//          if bodies come or go; O(n + k) memory, k = pairs, which are copied out.
#include <algorithm>
#include <array>

#include "algorithms/broad_phase.h"
#include "algorithms/broad_phase/sweep_and_prune/endpoint_list.h"
#include "algorithms/broad_phase/sweep_and_prune/pair_set.h"
#include "algorithms/core/memory_usage.h"
#include "algorithms/kernels/boxes/aabb_scan.h"
#include "algorithms/kernels/boxes/aabb_stack.h"
#include "algorithms/kernels/boxes/structure_boxes.h"

namespace touchstone {
namespace {

class SweepAndPrune final : public BroadPhase {
 public:
  explicit SweepAndPrune(Executor& executor)
      : executor_(executor), lists_(static_cast<std::size_t>(executor.width())) {}

  void build(std::span<const Aabb> boxes) override {
    wait_ = 0;
    rebuild(boxes);
  }

  void update(const FrameChange& change) override {
    if (repair(change)) return;
    if (skipped_ < wait_) {
      resort_axis(change.boxes);
    } else {
      rebuild(change.boxes);
    }
  }

  Status find_pairs(PairSink& sink) override;
  Status find_changes(PairSink& began, PairSink& ended) override;

  // The work of a sweep of the end points as they are, even if the pairs were kept.
  BroadPhaseWork work() const override {
    const EndpointList::Overlaps best =
        axes_[are_all_sorted_ ? best_axis() : axis_].count_overlaps();
    return {
        .box_tests = best.candidates + best.ended,
        .node_visits = 0,
        .candidates = best.candidates,
        .bytes = sum_held_bytes(found_, ids_, before_, axes_[0], axes_[1], axes_[2], radix_sort_,
                                arrays_, set_, mark_, jumpers_, walkers_, motion_)};
  }

  // The intervals on the axis of the last sweep, which was the best then. The other two may be
  // sorted as well.
  std::vector<StructureBox> structure() const override {
    std::vector<Aabb> boxes;
    for (const Endpoint point : axes_[axis_].points()) {
      if (!is_max(point)) boxes.push_back(before_[body_of(point)]);
    }
    return intervals_of(boxes, axis_);
  }

 private:
  static constexpr std::size_t pairs_a_chunk = 16384;
  static constexpr std::size_t rows_a_task = 512;

  void rebuild(std::span<const Aabb> boxes);
  void resort_axis(std::span<const Aabb> boxes);
  void take_boxes(std::span<const Aabb> boxes);
  std::size_t best_axis() const;
  void sweep(PairSink& sink);
  void keep(const PairSink& sink);

  bool repair(const FrameChange& change);
  void classify(const FrameChange& change);
  bool is_far(const Aabb& now, std::uint32_t id) const;
  void take_jumpers_out();
  void put_jumpers_in(std::span<const Aabb> boxes);

  Executor& executor_;
  std::vector<AabbStack> lists_;  // one for each worker
  std::vector<std::uint32_t> ids_;
  std::vector<Aabb> before_;  // boxes of the last frame, to which the end points belong
  std::array<EndpointList, 3> axes_{EndpointList(0), EndpointList(1), EndpointList(2)};
  RadixSort<Endpoint> radix_sort_;
  AabbSoA arrays_;  // sorted by the minima on the best axis for a sweep; by id for inserted bodies
  std::size_t axis_ = 0;
  bool swept_ = false;  // true while the pairs are yet to be found by a sweep
  // True if all axes are sorted, false if only the one of the sweep is.
  bool are_all_sorted_ = false;
  PairSink found_;
  PairSet set_;
  // All pairs of this frame, and those of the last call of find_changes, unless the set tells both.
  PairSink all_;
  PairHistory told_;
  EndpointMotion motion_;  // motion of the walkers
  std::vector<std::uint32_t> jumpers_, walkers_;
  std::vector<std::uint8_t> mark_;  // 1 for a jumper; indexed by id
  std::size_t most_passes_ = 0;     // limit for each axis and frame
  std::size_t skipped_ = 0, wait_ = 0;
};

void SweepAndPrune::rebuild(std::span<const Aabb> boxes) {
  take_boxes(boxes);
  are_all_sorted_ = true;
  for (EndpointList& axis : axes_) axis.sort(executor_, boxes, ids_, radix_sort_);
  axis_ = best_axis();
  // Measured: updating all three axes takes as long as the sweep if each has about one pass for
  // every hundred of the sweep's candidates.
  const auto candidates = static_cast<std::size_t>(axes_[axis_].count_overlaps().candidates);
  most_passes_ = 2 * ids_.size() + candidates / 96 + 256;
}

// Sorts one axis only; the others can wait while the next frames are swept too.
void SweepAndPrune::resort_axis(std::span<const Aabb> boxes) {
  take_boxes(boxes);
  are_all_sorted_ = false;
  axes_[axis_].sort(executor_, boxes, ids_, radix_sort_);
}

void SweepAndPrune::take_boxes(std::span<const Aabb> boxes) {
  if (set_.is_told()) told_.set(set_.told());
  before_.assign(boxes.begin(), boxes.end());
  mark_.assign(boxes.size(), 0);  // clears marks left by an abandoned update
  list_bodies(executor_, boxes, ids_);
  swept_ = true;
}

// The axis on which the fewest boxes overlap.
std::size_t SweepAndPrune::best_axis() const {
  std::size_t best = 0;
  std::int64_t fewest = axes_[0].count_overlaps().candidates;
  for (std::size_t axis = 1; axis < 3; ++axis) {
    const std::int64_t candidates = axes_[axis].count_overlaps().candidates;
    if (candidates < fewest) best = axis;
    fewest = std::min(fewest, candidates);
  }
  return best;
}

Status SweepAndPrune::find_pairs(PairSink& sink) {
  if (swept_) {
    sweep(sink);
    if (are_all_sorted_) keep(sink);
    return Status::ok;
  }
  const std::span<const IndexPair> pairs = set_.pairs();
  sink.start(block_count(pairs.size(), pairs_a_chunk));
  for_each_block(executor_, pairs.size(), pairs_a_chunk,
                 [&](std::size_t block, std::size_t first, std::size_t last) {
                   PairBuffer& out = sink.chunk(block);
                   out.reserve(last - first);
                   std::copy_n(pairs.data() + first, last - first, out.end());
                   out.advance(last - first);
                 });
  return Status::ok;
}

Status SweepAndPrune::find_changes(PairSink& began, PairSink& ended) {
  if (set_.is_told()) {
    set_.write_changes(began, ended);
    return Status::ok;
  }
  find_pairs(all_);
  told_.compare(all_, began, ended);
  if (!swept_) {
    set_.tell();
    all_ = {};
    told_ = {};
  }
  return Status::ok;
}

void SweepAndPrune::sweep(PairSink& sink) {
  std::size_t row = 0;
  for (const Endpoint point : axes_[axis_].points()) {
    if (!is_max(point)) ids_[row++] = body_of(point);
  }
  arrays_.gather(executor_, before_, ids_.size(), [&](std::size_t i) { return ids_[i]; });
  sink.start(block_count(arrays_.size(), rows_a_task));
  for_each_block(executor_, arrays_.size(), rows_a_task,
                 [&](std::size_t task, std::size_t first, std::size_t last) {
                   sweep_boxes(arrays_, static_cast<int>(axis_), {first, last}, sink.chunk(task));
                 });
}

void SweepAndPrune::keep(const PairSink& sink) {
  std::span<IndexPair> pairs = set_.refill(sink.size());
  for (const PairBuffer& chunk : sink.chunks()) {
    std::ranges::copy(chunk.pairs(), pairs.begin());
    pairs = pairs.subspan(chunk.size());
  }
  swept_ = false;
}

// Updates the end points and the set. Returns false if that takes too long; both are then invalid.
bool SweepAndPrune::repair(const FrameChange& change) {
  if (skipped_ < wait_ && change.moved.size() > before_.size() / 16) {
    ++skipped_;
    return false;
  }
  if (swept_) return false;
  before_.resize(change.boxes.size(), Aabb::empty());
  mark_.resize(change.boxes.size(), 0);
  classify(change);
  // A vector of 16 boxes takes as long as a pass.
  if (jumpers_.size() * (before_.size() / 16) > 3 * most_passes_) return false;
  if (!jumpers_.empty()) take_jumpers_out();

  std::array<bool, 3> repaired{};
  const auto axis_task = [&](std::size_t axis, int) {
    repaired[axis] = axes_[axis].repair(motion_, most_passes_);
  };
  executor_.run(3, std::cref(axis_task));
  if (!repaired[0] || !repaired[1] || !repaired[2]) {
    // The next frame will probably be like this one.
    wait_ = std::min(2 * wait_ + 1, std::size_t{15});
    skipped_ = 0;
    return false;
  }
  wait_ = 0;
  for (const EndpointList& axis : axes_) {
    for (const EndpointList::Change& c : axis.changes()) {
      c.comes ? set_.insert(c.pair) : set_.erase(c.pair);
    }
  }
  for (const std::uint32_t id : walkers_) before_[id] = change.boxes[id];
  if (!jumpers_.empty()) put_jumpers_in(change.boxes);
  return true;
}

// Splits the changed bodies into jumpers, which come, go or move far, and walkers.
void SweepAndPrune::classify(const FrameChange& change) {
  jumpers_.assign(change.removed.begin(), change.removed.end());
  jumpers_.insert(jumpers_.end(), change.inserted.begin(), change.inserted.end());
  walkers_.clear();
  if (change.moved.size() <= before_.size() / 16) {
    for (const std::uint32_t id : change.moved) {
      (is_far(change.boxes[id], id) ? jumpers_ : walkers_).push_back(id);
    }
  } else {
    // The limit on passes detects bodies that move far.
    walkers_.assign(change.moved.begin(), change.moved.end());
  }
  motion_.start(before_, change.boxes, walkers_);
}

// True if the body's minima pass many others.
bool SweepAndPrune::is_far(const Aabb& now, std::uint32_t id) const {
  const Aabb& then = before_[id];
  if (overlap(then, now)) return false;
  std::size_t passed = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    passed += axes_[axis].count_between(then.min[axis], now.min[axis]);
  }
  return passed > 64 + axes_[0].points().size() / 16;
}

void SweepAndPrune::take_jumpers_out() {
  for (const std::uint32_t id : jumpers_) mark_[id] = 1;
  set_.erase_if([&](IndexPair pair) { return mark_[pair.a] + mark_[pair.b] > 0; });
  const auto task = [&](std::size_t axis, int) { axes_[axis].take_out(mark_); };
  executor_.run(3, std::cref(task));
}

void SweepAndPrune::put_jumpers_in(std::span<const Aabb> boxes) {
  for (const std::uint32_t id : jumpers_) before_[id] = boxes[id];
  const auto task = [&](std::size_t axis, int) { axes_[axis].put_in(boxes, jumpers_); };
  executor_.run(3, std::cref(task));

  arrays_.resize(boxes.size());
  for_each_block(executor_, boxes.size(), 8192,
                 [&](std::size_t, std::size_t first, std::size_t last) {
                   for (std::size_t i = first; i < last; ++i) {
                     arrays_.set(i, boxes[i], static_cast<std::uint32_t>(i));
                   }
                 });
  found_.start(jumpers_.size());
  const auto query = [&](std::size_t i, int worker) {
    const std::uint32_t id = jumpers_[i];
    AabbStack& list = lists_[static_cast<std::size_t>(worker)];
    const std::size_t first = list.start();
    list.append(boxes[id], arrays_, {0, boxes.size()});
    for (std::size_t at = first; at < list.end(); ++at) {
      const std::uint32_t other = list.ids()[at];
      // A pair of two jumpers is found by the one with the smaller id.
      if (other != id && (mark_[other] == 0 || other > id)) found_.chunk(i).push(id, other);
    }
    list.drop(first);
  };
  executor_.run(jumpers_.size(), std::cref(query));
  for (const PairBuffer& chunk : found_.chunks()) {
    for (const IndexPair pair : chunk.pairs()) set_.insert(pair);
  }
  for (const std::uint32_t id : jumpers_) mark_[id] = 0;
}

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<BroadPhaseEntry> broad_phase_sweep_and_prune() {
  return {{.info = {.name = "sweep-and-prune",
                    .citation = "Baraff, thesis, Cornell 1992; Cohen, Lin, Manocha, Ponamgi, "
                                "\"I-COLLIDE\", I3D 1995; three axes, kept pairs"},
           .make = [](Executor& executor) { return std::make_unique<SweepAndPrune>(executor); }}};
}

}  // namespace touchstone::entries
