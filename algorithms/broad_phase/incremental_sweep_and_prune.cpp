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
// Cost:    O(m + s) a frame, for m bodies that move and s end points that pass each other; O(n + k)
//          where bodies come or go; O(n + k) memory, k = pairs, which are copied out.
#include <algorithm>
#include <array>
#include <bit>

#include "algorithms/broad_phase.h"
#include "algorithms/kernels/box_lanes.h"
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
// Without a branch: which of the two cannot be guessed.
EndPoint end_point(const Aabb& box, std::size_t axis, bool max, std::uint32_t id) {
  const auto low = std::bit_cast<std::uint32_t>(box.min[axis]);
  const auto high = std::bit_cast<std::uint32_t>(box.max[axis]);
  const std::uint32_t mask = 0 - std::uint32_t{max};
  return end_point(std::bit_cast<float>(low ^ ((low ^ high) & mask)), max, id);
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
    std::size_t found = 0;
    for (const PairBuffer& chunk : found_.chunks()) found += chunk.capacity() * sizeof(IndexPair);
    return {.box_tests = best.candidates + best.ended,
            .node_visits = 0,
            .candidates = best.candidates,
            .bytes = static_cast<std::int64_t>(found) +
                     sum_held_bytes(ids_, before_, points_[0], points_[1], points_[2], radix_sort_,
                                    arrays_, set_, mark_, jumpers_, walkers_, fresh_[0], fresh_[1],
                                    fresh_[2], changes_[0], changes_[1], changes_[2], shadows_[0],
                                    shadows_[1], shadows_[2], places_[0], places_[1], places_[2])};
  }

 private:
  static constexpr std::size_t pairs_a_chunk = 16384;
  static constexpr std::size_t rows_a_task = 512;

  struct Change {
    IndexPair pair;
    bool comes;
  };
  using Shadow = std::array<float, 4>;
  // Two end points that have changed places.
  struct Pass {
    EndPoint lower, upper;
  };
  using Passes = std::array<Pass, 1024>;
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
  void prepare(std::size_t axis);
  bool repair_all(std::size_t axis, std::span<const Aabb> boxes);
  bool repair_few(std::size_t axis, std::span<const Aabb> boxes);
  static constexpr std::ptrdiff_t down = -1, up = 1;
  template <std::ptrdiff_t way, bool with_places>
  std::size_t move(std::size_t axis, std::size_t at, std::span<EndPoint> points,
                   std::size_t& listed, std::span<const Aabb> boxes);
  void look_at_passes(std::size_t axis, std::size_t listed, std::span<const Aabb> boxes);
  // Of a body, on the two other axes: as it is in one box on the first, in another on the second.
  void set_shadow(std::size_t axis, std::uint32_t id, const Aabb& first, const Aabb& second) {
    const std::size_t i = axis == 0 ? 1 : 0;
    const std::size_t j = axis == 2 ? 1 : 2;
    shadows_[axis][id] = {first.min[i], -first.max[i], second.min[j], -second.max[j]};
  }
  // The place of an end point in the sorted ones.
  std::uint32_t& place(std::size_t axis, EndPoint point) {
    return places_[axis][2 * body_of(point) + (is_max(point) ? 1 : 0)];
  }

  Executor& executor_;
  std::vector<BoxList> lists_;  // one a worker
  std::vector<std::uint32_t> ids_;
  std::vector<Aabb> before_;  // the boxes that the end points are of
  std::array<std::vector<EndPoint>, 3> points_, fresh_;
  // By id, of each axis: where the box lies on the two others, minima and maxima with the sign
  // turned, as they are when this axis is repaired: those before it already are.
  std::array<std::vector<Shadow>, 3> shadows_;
  std::array<std::vector<std::uint32_t>, 3> places_;  // of minimum and maximum, by id
  bool shadowed_ = false, placed_ = false;            // whether these are up to date
  RadixSort<EndPoint> radix_sort_;
  BoxArrays arrays_;  // by minimum on the best axis, for a sweep; by id, for bodies that come
  std::size_t axis_ = 0;
  bool few_ = false;    // of the bodies have moved
  bool swept_ = false;  // the pairs are yet to be found, by a sweep
  PairSink found_;
  PairSet set_;
  std::array<Passes, 3> passes_;  // that are yet to be looked at
  std::array<std::vector<Change>, 3> changes_;
  std::vector<std::uint32_t> jumpers_, walkers_;
  std::vector<std::uint8_t> mark_;  // by id: it is a jumper
  std::size_t most_passes_ = 0;     // on an axis, in a frame
  std::size_t skipped_ = 0, wait_ = 0;
};

void IncrementalSweepAndPrune::rebuild(std::span<const Aabb> boxes) {
  before_.assign(boxes.begin(), boxes.end());
  mark_.assign(boxes.size(), 0);  // some are left where a repair was given up
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
  // Measured: all three axes are repaired as fast as the sweep is made when each takes a pass for
  // every hundred of the sweep's candidates, or so.
  const auto candidates = static_cast<std::size_t>(overlaps_on(axis_).candidates);
  most_passes_ = 2 * ids_.size() + candidates / 96 + 256;
  swept_ = true;
  shadowed_ = placed_ = false;
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
  if (jumpers_.size() * (before_.size() / 16) > 3 * most_passes_) return false;
  if (!jumpers_.empty()) take_jumpers_out();

  std::array<bool, 3> repaired{};
  const auto axis_task = [&](std::size_t axis, int) {
    prepare(axis);
    shadows_[axis].resize(before_.size());
    if (axis > 0) {
      const Aabb* const second = axis == 1 ? before_.data() : change.boxes.data();
      for (const std::uint32_t id : walkers_) set_shadow(axis, id, change.boxes[id], second[id]);
    }
    changes_[axis].clear();
    repaired[axis] = few_ ? repair_few(axis, change.boxes) : repair_all(axis, change.boxes);
    if (axis < 2) {
      for (const std::uint32_t id : walkers_) {
        set_shadow(axis, id, change.boxes[id], change.boxes[id]);
      }
    }
  };
  executor_.run(3, std::cref(axis_task));
  shadowed_ = true;
  placed_ = few_;
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
  few_ = change.moved.size() <= before_.size() / 16;
  for (const std::uint32_t id : change.moved) {
    // Where many move, those that move far are told by the passes that they take.
    (few_ && is_far(change.boxes[id], id) ? jumpers_ : walkers_).push_back(id);
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
  placed_ = false;
}

void IncrementalSweepAndPrune::put_jumpers_in(std::span<const Aabb> boxes) {
  for (const std::uint32_t id : jumpers_) before_[id] = boxes[id];
  placed_ = false;
  const auto task = [&](std::size_t axis, int) {
    for (const std::uint32_t id : jumpers_) set_shadow(axis, id, boxes[id], boxes[id]);
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

// Before an axis is repaired: what of the frame it sees.
void IncrementalSweepAndPrune::prepare(std::size_t axis) {
  std::vector<Shadow>& shadows = shadows_[axis];
  if (!shadowed_) {
    shadows.resize(before_.size());
    for (std::uint32_t id = 0; id < before_.size(); ++id) {
      set_shadow(axis, id, before_[id], before_[id]);
    }
  }
  if (!placed_ && few_) {
    places_[axis].resize(2 * before_.size());
    for (std::uint32_t at = 0; at < points_[axis].size(); ++at) {
      place(axis, points_[axis][at]) = at;
    }
  }
}

// Insertion sort; false when that takes too many passes.
bool IncrementalSweepAndPrune::repair_all(std::size_t axis, std::span<const Aabb> boxes) {
  const std::span<EndPoint> points = points_[axis];
  std::size_t passes = 0;
  std::size_t listed = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::uint32_t id = body_of(points[i]);
    points[i] = end_point(boxes[id], axis, is_max(points[i]), id);
    passes += move<down, false>(axis, i, points, listed, boxes);
    if (passes > most_passes_) return false;
  }
  look_at_passes(axis, listed, boxes);
  return true;
}

// The same, where most end points stay where they are.
bool IncrementalSweepAndPrune::repair_few(std::size_t axis, std::span<const Aabb> boxes) {
  const std::span<EndPoint> points = points_[axis];
  std::size_t passes = 0;
  std::size_t listed = 0;
  for (const std::uint32_t id : walkers_) {
    for (const bool max : {false, true}) {
      const EndPoint now = end_point(boxes[id], axis, max, id);
      const std::size_t at = place(axis, now);
      const EndPoint then = points[at];
      points[at] = now;
      passes += now < then ? move<down, true>(axis, at, points, listed, boxes)
                           : move<up, true>(axis, at, points, listed, boxes);
      if (passes > most_passes_) return false;
    }
  }
  look_at_passes(axis, listed, boxes);
  return true;
}

// Moves the end point at a place to where it belongs, and lists those of the other kind that it
// passes; how many it passes in all.
template <std::ptrdiff_t way, bool with_places>
std::size_t IncrementalSweepAndPrune::move(std::size_t axis, std::size_t at,
                                           std::span<EndPoint> points, std::size_t& listed,
                                           std::span<const Aabb> boxes) {
  const EndPoint point = points[at];
  const auto is_next = [&](std::size_t to) {
    if constexpr (way == down) return to > 0 && point < points[to - 1];
    return to + 1 < points.size() && points[to + 1] < point;
  };
  Passes& passes = passes_[axis];
  std::size_t to = at;
  while (is_next(to)) {
    const EndPoint other = points[to] = points[to + way];
    if constexpr (with_places) place(axis, other) = static_cast<std::uint32_t>(to);
    to += way;
    // No branch: whether it is a minimum or a maximum cannot be guessed.
    passes[listed] = way == down ? Pass{point, other} : Pass{other, point};
    listed += (other ^ point) >> 31 & 1;
    if (listed == passes.size()) {
      look_at_passes(axis, listed, boxes);
      listed = 0;
    }
  }
  points[to] = point;
  if constexpr (with_places) place(axis, point) = static_cast<std::uint32_t>(to);
  return way == down ? at - to : to - at;
}

// Of the end points that have passed each other. A pair comes, or goes, where the boxes overlap on
// this axis after the frame, or before it, but not both; and overlap on the axes that are repaired
// before this one after the frame, and on the others before it. So it may be found more than once,
// but never for another change than the axis makes.
void IncrementalSweepAndPrune::look_at_passes(std::size_t axis, std::size_t listed,
                                              std::span<const Aabb> boxes) {
  using Lanes = box_lanes::baseline::Lanes;
  const Shadow* const shadows = shadows_[axis].data();
  for (const Pass& pass : std::span(passes_[axis]).first(listed)) {
    const std::uint32_t a = body_of(pass.lower);
    const std::uint32_t b = body_of(pass.upper);
    const Shadow& own = shadows[a];
    const Lanes::Floats reach{-own[1], -own[0], -own[3], -own[2]};
    if (Lanes::bits(Lanes::less_equal(Lanes::load(shadows[b].data()), reach)) != 0xf) continue;
    const bool comes = is_max(pass.upper);
    const bool now = overlap_on(boxes[a], boxes[b], axis);
    const bool then = overlap_on(before_[a], before_[b], axis);
    if (now != comes || then == comes) continue;
    changes_[axis].push_back({{std::min(a, b), std::max(a, b)}, comes});
  }
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
