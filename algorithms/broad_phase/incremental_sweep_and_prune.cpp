// Incremental sweep and prune: the boxes' end points are kept sorted on three axes from frame to
// frame, and a set of pairs that changes only where a minimum and a maximum pass each other.
// Paper:   Baraff, "Dynamic Simulation of Non-Penetrating Rigid Bodies", thesis, Cornell 1992;
//          Cohen, Lin, Manocha, Ponamgi, "I-COLLIDE", I3D 1995.
// Departs: the three axes are repaired at the same time: each lists its own changes as if those
//          before it had been repaired, and those behind it had not, and the lists are carried out
//          in the order of the axes. Bodies that come, go or move far are taken out of the end
//          points and merged in again, in one pass, and meet all boxes a vector at a time. When the
//          end points pass each other more often than a sweep of the best axis would take, they are
//          sorted afresh, and the set is made by that sweep.
// Fails:   dense or fast scenes in which all move: an end point passes others in proportion to
//          n^(2/3) times its way, and in flat or stacked scenes to n. The sweep that is then made
//          goes like n^(5/3), and n^2 where most boxes overlap on every axis.
// Cost:    O(m log n + s) a frame, for m bodies that move and s end points that pass each other,
// and
//          O(n + k) where bodies come or go; O(n + k) memory, k = pairs, which are copied out.
#include <algorithm>
#include <array>
#include <bit>

#include "algorithms/broad_phase.h"
#include "algorithms/kernels/box_list.h"
#include "algorithms/kernels/box_scan.h"
#include "algorithms/kernels/held_bytes.h"
#include "algorithms/kernels/ordered_key.h"
#include "algorithms/kernels/pair_set.h"
#include "algorithms/kernels/radix_sort.h"

namespace touchstone {
namespace {

// A key above, then whether it is a maximum, then the body: closed boxes that touch overlap because
// minima come first.
using EndPoint = std::uint64_t;

EndPoint end_point(float x, bool is_max, std::uint32_t id) {
  return sort_item(ordered_key(x), (is_max ? 0x80000000u : 0) | id);
}
bool is_max(EndPoint point) { return (point >> 31 & 1) != 0; }
std::uint32_t body_of(EndPoint point) { return static_cast<std::uint32_t>(point) & 0x7fffffff; }
EndPoint end_point(const Aabb& box, std::size_t axis, bool max, std::uint32_t id) {
  return end_point(max ? box.max[axis] : box.min[axis], max, id);
}

bool overlap_on(const Aabb& a, const Aabb& b, std::size_t axis) {
  return a.min[axis] <= b.max[axis] && b.min[axis] <= a.max[axis];
}

class IncrementalSweepAndPrune final : public BroadPhase {
 public:
  explicit IncrementalSweepAndPrune(Executor& executor)
      : executor_(executor), lists_(static_cast<std::size_t>(executor.width())) {}

  void build(std::span<const Aabb> boxes) override {
    wait_ = 0;
    rebuild(boxes);
  }

  void update(const FrameChange& change) override {
    if (!repair(change)) rebuild(change.boxes);
  }

  Status find_pairs(PairSink& sink) override {
    if (swept_) {
      sweep(sink);
      keep(sink);
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

  // What a sweep of the end points as they stand takes; of pairs that have been kept, too.
  BroadPhaseWork work() const override {
    const Overlaps best = overlaps_on(best_axis());
    return {.box_tests = best.candidates + best.ended,
            .node_visits = 0,
            .candidates = best.candidates,
            .bytes = sum_held_bytes(ids_, before_, points_[0], points_[1], points_[2], radix_sort_,
                                    arrays_, set_, mark_, jumpers_, walkers_, fresh_[0], fresh_[1],
                                    fresh_[2], changes_[0], changes_[1], changes_[2])};
  }

 private:
  static constexpr std::size_t pairs_a_chunk = 16384;
  static constexpr std::size_t rows_a_task = 512;

  struct Change {
    IndexPair pair;
    bool comes;
  };
  // On an axis.
  struct Overlaps {
    std::int64_t candidates = 0;  // pairs that overlap there
    std::int64_t ended = 0;       // bodies that end before the last begins
  };

  void rebuild(std::span<const Aabb> boxes);
  Overlaps overlaps_on(std::size_t axis) const;
  std::size_t best_axis() const;
  void sweep(PairSink& sink);
  void keep(const PairSink& sink);

  bool repair(const FrameChange& change);
  void classify(const FrameChange& change);
  bool is_far(const Aabb& now, std::uint32_t id) const;
  void take_jumpers_out();
  void put_jumpers_in(std::span<const Aabb> boxes);
  bool repair_axis(std::size_t axis, std::span<const Aabb> boxes);
  bool repair_all(std::size_t axis, std::span<const Aabb> boxes);
  bool repair_few(std::size_t axis, std::span<const Aabb> boxes);
  std::size_t sink_point(std::size_t axis, std::size_t at, std::span<const Aabb> boxes);
  std::size_t raise_point(std::size_t axis, std::size_t at, std::span<const Aabb> boxes);
  void pass(EndPoint lower, EndPoint upper, std::size_t axis, std::span<const Aabb> boxes);

  Executor& executor_;
  std::vector<BoxList> lists_;  // one a worker
  std::vector<std::uint32_t> ids_;
  std::vector<Aabb> before_;  // the boxes that the end points are of
  std::array<std::vector<EndPoint>, 3> points_, fresh_;
  RadixSort<EndPoint> radix_sort_;
  BoxArrays arrays_;  // by minimum on the best axis, for a sweep; by id, for bodies that come
  std::size_t axis_ = 0;
  bool swept_ = false;  // the pairs are yet to be found, by a sweep
  PairSink found_;
  PairSet set_;
  std::array<std::vector<Change>, 3> changes_;
  std::vector<std::uint32_t> jumpers_, walkers_;
  std::vector<std::uint8_t> mark_;  // by id: it is a jumper
  std::size_t most_passes_ = 0;     // on an axis, in a frame
  std::size_t skipped_ = 0, wait_ = 0;
};

void IncrementalSweepAndPrune::rebuild(std::span<const Aabb> boxes) {
  before_.assign(boxes.begin(), boxes.end());
  mark_.resize(boxes.size(), 0);
  list_bodies(executor_, boxes, ids_);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::vector<EndPoint>& points = points_[axis];
    points.resize(2 * ids_.size());
    for_each_block(executor_, ids_.size(), 8192,
                   [&](std::size_t, std::size_t first, std::size_t last) {
                     for (std::size_t i = first; i < last; ++i) {
                       points[i] = end_point(boxes[ids_[i]], axis, false, ids_[i]);
                       points[ids_.size() + i] = end_point(boxes[ids_[i]], axis, true, ids_[i]);
                     }
                   });
    radix_sort_(executor_, points, 33, [](EndPoint point) { return point >> 31; });
  }
  axis_ = best_axis();
  // Sorting and gathering take as long as some passes, the sweep as a pass for every ten pairs.
  const auto candidates = static_cast<std::size_t>(overlaps_on(axis_).candidates);
  most_passes_ = 8 * ids_.size() + candidates / 16 + 256;
  swept_ = true;
}

IncrementalSweepAndPrune::Overlaps IncrementalSweepAndPrune::overlaps_on(std::size_t axis) const {
  const auto bodies = static_cast<std::int64_t>(points_[axis].size() / 2);
  Overlaps overlaps;
  std::int64_t begun = 0;
  std::int64_t open = 0;
  for (const EndPoint point : points_[axis]) {
    const std::int64_t max = is_max(point) ? 1 : 0;
    overlaps.candidates += (1 - max) * open;
    overlaps.ended += max * (begun < bodies ? 1 : 0);
    begun += 1 - max;
    open += 1 - 2 * max;
  }
  return overlaps;
}

// On which the fewest boxes overlap.
std::size_t IncrementalSweepAndPrune::best_axis() const {
  std::size_t best = 0;
  std::int64_t fewest = overlaps_on(0).candidates;
  for (std::size_t axis = 1; axis < 3; ++axis) {
    const std::int64_t candidates = overlaps_on(axis).candidates;
    if (candidates < fewest) best = axis;
    fewest = std::min(fewest, candidates);
  }
  return best;
}

void IncrementalSweepAndPrune::sweep(PairSink& sink) {
  std::size_t row = 0;
  for (const EndPoint point : points_[axis_]) {
    if (!is_max(point)) ids_[row++] = body_of(point);
  }
  arrays_.gather(executor_, before_, ids_.size(), [&](std::size_t i) { return ids_[i]; });
  sink.start(block_count(arrays_.size(), rows_a_task));
  for_each_block(executor_, arrays_.size(), rows_a_task,
                 [&](std::size_t task, std::size_t first, std::size_t last) {
                   sweep_boxes(arrays_, static_cast<int>(axis_), {first, last}, sink.chunk(task));
                 });
}

void IncrementalSweepAndPrune::keep(const PairSink& sink) {
  std::span<IndexPair> pairs = set_.refill(sink.size());
  for (const PairBuffer& chunk : sink.chunks()) {
    std::ranges::copy(chunk.pairs(), pairs.begin());
    pairs = pairs.subspan(chunk.size());
  }
  swept_ = false;
}

// Brings the end points and the set up to date, or gives up, where it takes too long: they are then
// of no use.
bool IncrementalSweepAndPrune::repair(const FrameChange& change) {
  if (skipped_ < wait_ && change.moved.size() > before_.size() / 16) {
    ++skipped_;
    return false;
  }
  if (swept_) return false;
  before_.resize(change.boxes.size(), Aabb::empty());
  mark_.resize(change.boxes.size(), 0);
  classify(change);
  // A vector of 16 boxes takes as long as a pass.
  if (jumpers_.size() * (before_.size() / 16) > most_passes_) return false;
  if (!jumpers_.empty()) take_jumpers_out();

  std::array<bool, 3> repaired{};
  const auto axis_task = [&](std::size_t axis, int) {
    changes_[axis].clear();
    repaired[axis] = repair_axis(axis, change.boxes);
  };
  executor_.run(3, std::cref(axis_task));
  if (!repaired[0] || !repaired[1] || !repaired[2]) {
    // Mostly the next frame will be like this one.
    wait_ = std::min(2 * wait_ + 1, std::size_t{15});
    skipped_ = 0;
    return false;
  }
  wait_ = 0;
  for (const std::vector<Change>& changes : changes_) {
    for (const Change& c : changes) c.comes ? set_.insert(c.pair) : set_.erase(c.pair);
  }
  for (const std::uint32_t id : walkers_) before_[id] = change.boxes[id];
  if (!jumpers_.empty()) put_jumpers_in(change.boxes);
  return true;
}

// Bodies that come, go or move far are jumpers, the others that move are walkers.
void IncrementalSweepAndPrune::classify(const FrameChange& change) {
  jumpers_.assign(change.removed.begin(), change.removed.end());
  jumpers_.insert(jumpers_.end(), change.inserted.begin(), change.inserted.end());
  walkers_.clear();
  const bool few = change.moved.size() <= before_.size() / 16;
  for (const std::uint32_t id : change.moved) {
    // Where many move, those that move far are told by the passes that they take.
    (few && is_far(change.boxes[id], id) ? jumpers_ : walkers_).push_back(id);
  }
}

// True when its minima pass many others.
bool IncrementalSweepAndPrune::is_far(const Aabb& now, std::uint32_t id) const {
  const Aabb& then = before_[id];
  if (overlap(then, now)) return false;
  std::size_t passed = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::vector<EndPoint>& points = points_[axis];
    const auto [low, high] = std::minmax(then.min[axis], now.min[axis]);
    const auto from = std::ranges::lower_bound(points, end_point(low, false, 0));
    const auto to = std::ranges::lower_bound(points, end_point(high, false, 0));
    passed += static_cast<std::size_t>(to - from);
  }
  return passed > 64 + points_[0].size() / 16;
}

void IncrementalSweepAndPrune::take_jumpers_out() {
  for (const std::uint32_t id : jumpers_) mark_[id] = 1;
  set_.erase_if([&](IndexPair pair) { return mark_[pair.a] + mark_[pair.b] > 0; });
  const auto task = [&](std::size_t axis, int) {
    std::erase_if(points_[axis], [&](EndPoint point) { return mark_[body_of(point)] != 0; });
  };
  executor_.run(3, std::cref(task));
}

void IncrementalSweepAndPrune::put_jumpers_in(std::span<const Aabb> boxes) {
  for (const std::uint32_t id : jumpers_) before_[id] = boxes[id];
  const auto task = [&](std::size_t axis, int) {
    std::vector<EndPoint>& fresh = fresh_[axis];
    fresh.clear();
    for (const std::uint32_t id : jumpers_) {
      if (boxes[id].is_empty()) continue;
      fresh.push_back(end_point(boxes[id], axis, false, id));
      fresh.push_back(end_point(boxes[id], axis, true, id));
    }
    std::ranges::sort(fresh);
    // From the back, in the place of the old ones.
    std::vector<EndPoint>& points = points_[axis];
    std::size_t old = points.size();
    points.resize(old + fresh.size());
    for (std::size_t to = points.size(), more = fresh.size(); more > 0;) {
      const bool take = old == 0 || points[old - 1] < fresh[more - 1];
      points[--to] = take ? fresh[--more] : points[--old];
    }
  };
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
    BoxList& list = lists_[static_cast<std::size_t>(worker)];
    const std::size_t first = list.start();
    list.append(boxes[id], arrays_, {0, boxes.size()});
    for (std::size_t at = first; at < list.end(); ++at) {
      const std::uint32_t other = list.ids()[at];
      // Of two jumpers, the one with the smaller id.
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

// Sorts the walkers' end points on an axis; false when that takes too many passes.
bool IncrementalSweepAndPrune::repair_axis(std::size_t axis, std::span<const Aabb> boxes) {
  return walkers_.size() > before_.size() / 16 ? repair_all(axis, boxes) : repair_few(axis, boxes);
}

bool IncrementalSweepAndPrune::repair_all(std::size_t axis, std::span<const Aabb> boxes) {
  std::vector<EndPoint>& points = points_[axis];
  std::size_t passes = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::uint32_t id = body_of(points[i]);
    points[i] = end_point(boxes[id], axis, is_max(points[i]), id);
    passes += sink_point(axis, i, boxes);
    if (passes > most_passes_) return false;
  }
  return true;
}

bool IncrementalSweepAndPrune::repair_few(std::size_t axis, std::span<const Aabb> boxes) {
  std::vector<EndPoint>& points = points_[axis];
  std::size_t passes = 0;
  for (const std::uint32_t id : walkers_) {
    for (const bool max : {false, true}) {
      const EndPoint then = end_point(before_[id], axis, max, id);
      const EndPoint now = end_point(boxes[id], axis, max, id);
      if (now == then) continue;
      const auto at = std::ranges::lower_bound(points, then);
      *at = now;
      const auto place = static_cast<std::size_t>(at - points.begin());
      passes += now < then ? sink_point(axis, place, boxes) : raise_point(axis, place, boxes);
      if (passes > most_passes_) return false;
    }
  }
  return true;
}

// Moves the end point at a place down to where it belongs; how many it passes.
std::size_t IncrementalSweepAndPrune::sink_point(std::size_t axis, std::size_t at,
                                                 std::span<const Aabb> boxes) {
  EndPoint* const points = points_[axis].data();
  const EndPoint point = points[at];
  std::size_t to = at;
  for (; to > 0 && point < points[to - 1]; --to) {
    points[to] = points[to - 1];
    pass(point, points[to], axis, boxes);
  }
  points[to] = point;
  return at - to;
}

std::size_t IncrementalSweepAndPrune::raise_point(std::size_t axis, std::size_t at,
                                                  std::span<const Aabb> boxes) {
  EndPoint* const points = points_[axis].data();
  const std::size_t last = points_[axis].size() - 1;
  const EndPoint point = points[at];
  std::size_t to = at;
  for (; to < last && points[to + 1] < point; ++to) {
    points[to] = points[to + 1];
    pass(points[to], point, axis, boxes);
  }
  points[to] = point;
  return to - at;
}

// Two end points have changed places, and now one is below the other. A pair comes, or goes, where
// the boxes overlap on this axis after the frame, or before it, but not both; and overlap on the
// axes that are repaired before this one after the frame, and on the others before it. So it may be
// found more than once, but never for another change than the axis makes.
void IncrementalSweepAndPrune::pass(EndPoint lower, EndPoint upper, std::size_t axis,
                                    std::span<const Aabb> boxes) {
  if (is_max(lower) == is_max(upper)) return;
  const std::uint32_t a = body_of(lower);
  const std::uint32_t b = body_of(upper);
  for (std::size_t other = 0; other < 3; ++other) {
    if (other == axis) continue;
    const bool overlapping = other < axis ? overlap_on(boxes[a], boxes[b], other)
                                          : overlap_on(before_[a], before_[b], other);
    if (!overlapping) return;
  }
  const bool comes = is_max(upper);
  const bool now = overlap_on(boxes[a], boxes[b], axis);
  const bool then = overlap_on(before_[a], before_[b], axis);
  if (now != comes || then == comes) return;
  changes_[axis].push_back({{std::min(a, b), std::max(a, b)}, comes});
}

}  // namespace
}  // namespace touchstone

TOUCHSTONE_BROAD_PHASE {
  return {{.info = {.name = "incremental-sweep-and-prune",
                    .citation = "Baraff, thesis, Cornell 1992; Cohen, Lin, Manocha, Ponamgi, "
                                "\"I-COLLIDE\", I3D 1995; three axes, kept pairs"},
           .make = [](touchstone::Executor& executor) {
             return std::make_unique<touchstone::IncrementalSweepAndPrune>(executor);
           }}};
}
