// Dynamic BVH: a tree of boxes that are a little larger than the bodies', and the pairs of those
// that overlap; a body that stays in its fat box changes neither, and only the others look anew.
// Paper:   Catto, "Dynamic Bounding Volume Hierarchies", GDC 2019; Presson's btDbvt in Bullet, 2008
//          (fat boxes, pairs that persist); Rouwe, Jolt's QuadTree, 2021 (wide nodes).
// Departs: nodes have 16 children, see kernels/wide_tree.h. The margin follows what bodies move a
//          frame, and is at most a tenth of their size. No subtree is rebuilt: once many bodies
//          have left their boxes, a few frames' worth of motion, the tree is loaded anew in bulk,
//          along a Hilbert curve. Where bodies are too fast for a margin, or crowded, that is done
//          each frame without one, and pairs are not kept but looked for.
// Fails:   a body that overlaps most others and moves: its pairs are all made anew.
// Cost:    O(n + k) to be expected where most move; O(m log n) and going over the k pairs where m
//          do. O(n + k) memory; k = pairs of fat boxes. About 190 bytes a body and 35 a pair.
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <utility>

#include "algorithms/broad_phase.h"
#include "algorithms/kernels/box_lanes.h"
#include "algorithms/kernels/curve_keys.h"
#include "algorithms/kernels/group_scan.h"
#include "algorithms/kernels/held_bytes.h"
#include "algorithms/kernels/wide_tree.h"

namespace touchstone {
namespace {

class DynamicBvh final : public BroadPhase {
 public:
  explicit DynamicBvh(Executor& executor)
      : executor_(executor), scratch_(static_cast<std::size_t>(executor.width())) {}

  void build(std::span<const Aabb> boxes) override {
    is_sorted_ = false;
    keeps_pairs_ = false;
    load(boxes, 0);
  }

  void update(const FrameChange& change) override;
  Status find_pairs(PairSink& sink) override;
  BroadPhaseWork work() const override;

 private:
  static constexpr std::size_t leaves_a_task = 32;
  static constexpr std::size_t pairs_a_task = 16384;
  static constexpr std::size_t bodies_a_task = 64;
  // Of the bodies: if more leave their boxes than that, all is made anew.
  static constexpr std::size_t few = 16;
  static constexpr float most_margin = 0.1f;  // of a body's longest side
  static constexpr float frames_ahead = 8;
  static constexpr std::size_t most_pairs_a_body = 64;
  static constexpr std::size_t most_pairs = std::size_t{1} << 30;  // links are of 32 bits
  static constexpr std::size_t everything = std::numeric_limits<std::size_t>::max();
  static constexpr std::uint32_t none = 0xffffffff;

  using Lanes = box_lanes::baseline::Lanes;
  // A body's own box, the fourth number of each corner being zero: a vector's worth.
  struct alignas(32) Body {
    std::array<float, 4> low, high;
  };
  struct Scratch {
    WideTreeScratch tree;
    GroupScratch group;
  };
  struct Motion {
    float usual = 0;       // what nine in ten move, of those that a margin can serve
    std::size_t fast = 0;  // bodies that leave any margin within four frames
  };

  static Body body_of(const Aabb& box) {
    return {{box.min[0], box.min[1], box.min[2], 0}, {box.max[0], box.max[1], box.max[2], 0}};
  }
  static std::uint8_t meet(const Body& a, const Body& b) {
    const auto test = Lanes::less_equal(Lanes::load(a.low.data()), Lanes::load(b.high.data()));
    return Lanes::bits(Lanes::less_equal(test, Lanes::load(b.low.data()),
                                         Lanes::load(a.high.data()))) == 15;
  }
  static float longest_side(const Aabb& box) {
    return std::max({box.max[0] - box.min[0], box.max[1] - box.min[1], box.max[2] - box.min[2]});
  }
  IndexPair ids_of(const IndexPair& ranks) const {
    const auto [a, b] = std::minmax(id_of_[ranks.a], id_of_[ranks.b]);
    return {a, b};
  }
  Aabb fat(const Aabb& box) const {
    constexpr float most = std::numeric_limits<float>::max();
    const float margin = std::min(margin_, most_margin * longest_side(box));
    Aabb grown;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      grown.min[axis] = std::max(box.min[axis] - margin, -most);
      grown.max[axis] = std::min(box.max[axis] + margin, most);
    }
    return grown;
  }
  static bool contains(const Aabb& outer, const Aabb& inner) {
    bool within = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      within &= outer.min[axis] <= inner.min[axis] && inner.max[axis] <= outer.max[axis];
    }
    return within;
  }

  Motion motion_of(const FrameChange& change) const;
  void make_anew(const FrameChange& change, const Motion& motion);
  void load(std::span<const Aabb> boxes, float margin);
  void fill_tree(std::span<const Aabb> boxes);
  bool search(std::size_t task, Scratch& scratch, std::size_t most, PairBuffer& out) const;
  bool search_all(std::size_t most_a_task, PairSink& sink);
  bool keep_pairs();

  void take_boxes(const FrameChange& change);
  void take_box(std::uint32_t rank, const Aabb& box);
  void change_tree(const FrameChange& change);
  void list_pairs_of(std::span<const std::uint32_t> ranks);
  void link_pairs();
  void link(std::size_t pair);
  void remove_pairs_of(std::span<const std::uint32_t> ranks);
  void test_pairs(std::span<const std::uint32_t> moved);
  void look_anew();

  Executor& executor_;
  std::vector<Scratch> scratch_;
  std::vector<std::uint32_t> ids_;
  CurveKeys order_;
  bool is_sorted_ = false;     // the order is of the bodies that are there
  double spread_at_sort_ = 0;  // of the tree's leaves
  WideTree tree_;
  float margin_ = 0;
  std::size_t count_ = 0;  // of bodies

  // Bodies have ranks, in the order in which they were loaded or came later; rank 0 is nobody's,
  // and its box meets nobody.
  std::vector<Body> bodies_;
  std::vector<Aabb> fats_;
  std::vector<std::uint32_t> id_of_;    // of each rank; none of those that are gone
  std::vector<std::uint32_t> rank_of_;  // of each id

  // Pairs of fat boxes, where they are kept; in order of their discovery, gone ones of rank 0.
  bool keeps_pairs_ = false;
  std::vector<IndexPair> ranks_;
  std::vector<IndexPair> pairs_;     // their ids
  std::vector<std::uint8_t> meets_;  // 1 where the bodies' own boxes overlap
  std::size_t gone_ = 0;
  // The pairs of a body, linked: 2 p for its being the first of pair p, 2 p + 1 for the second.
  bool are_linked_ = false;
  std::vector<std::uint32_t> first_of_;  // of each rank
  std::vector<std::uint32_t> next_;
  std::vector<std::uint32_t> open_, listed_;  // of list_pairs_of
  // Ranks of those that moved or go, and of those that have left their boxes or are new, in this
  // frame; and how many have since the tree was loaded.
  std::vector<std::uint32_t> moved_, leavers_;
  std::vector<std::uint8_t> is_leaver_;  // of each rank
  std::size_t left_ = 0;
  PairSink found_;
};

// --- all bodies ---

// From a sample of those that moved.
DynamicBvh::Motion DynamicBvh::motion_of(const FrameChange& change) const {
  constexpr std::size_t sample_size = 256;
  Motion motion;
  const std::size_t count = std::min(change.moved.size(), sample_size);
  std::array<float, sample_size> slow;
  std::size_t slow_count = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t id = change.moved[i * change.moved.size() / count];
    const Aabb& box = change.boxes[id];
    const Body& before = bodies_[rank_of_[id]];
    float moved = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      moved = std::max({moved, std::abs(box.min[axis] - before.low[axis]),
                        std::abs(box.max[axis] - before.high[axis])});
    }
    if (moved <= 0.25f * most_margin * longest_side(box)) slow[slow_count++] = moved;
  }
  if (count > 0) motion.fast = (count - slow_count) * change.moved.size() / count;
  if (slow_count > 0) {
    const auto at = slow.begin() + static_cast<std::ptrdiff_t>((slow_count - 1) * 9 / 10);
    std::nth_element(slow.begin(), at, slow.begin() + static_cast<std::ptrdiff_t>(slow_count));
    motion.usual = *at;
  }
  return motion;
}

void DynamicBvh::make_anew(const FrameChange& change, const Motion& motion) {
  const std::size_t churn = change.inserted.size() + change.removed.size();
  if (churn > 0) is_sorted_ = false;
  keeps_pairs_ = motion.fast + churn <= count_ / few;
  load(change.boxes, keeps_pairs_ ? frames_ahead * motion.usual : 0);
  if (!keeps_pairs_ || keep_pairs()) return;
  keeps_pairs_ = false;
  load(change.boxes, 0);
}

void DynamicBvh::load(std::span<const Aabb> boxes, float margin) {
  margin_ = margin;
  left_ = 0;
  rank_of_.resize(boxes.size());
  const bool was_sorted = is_sorted_;
  if (!was_sorted) {
    list_bodies(executor_, boxes, ids_);
    order_.sort(executor_, boxes, ids_);
  }
  fill_tree(boxes);
  // Written so that a NaN, of bounds that overflow, makes a new order.
  if (was_sorted && !(tree_.spread() <= 1.25 * spread_at_sort_)) {
    order_.sort(executor_, boxes, ids_);
    fill_tree(boxes);
    is_sorted_ = false;
  }
  if (!is_sorted_) spread_at_sort_ = tree_.spread();
  is_sorted_ = true;
}

// The tree is of ranks where pairs are kept, and otherwise of ids, which are then the pairs found.
void DynamicBvh::fill_tree(std::span<const Aabb> boxes) {
  count_ = order_.size();
  bodies_.resize(count_ + 1);
  bodies_[0] = body_of(Aabb::empty());
  const std::size_t ranks = keeps_pairs_ ? count_ + 1 : 0;
  fats_.resize(ranks);
  id_of_.resize(ranks);
  is_leaver_.assign(ranks, 0);
  BoxArrays& arrays = tree_.start(count_);
  for_each_block(executor_, count_, 4096, [&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const std::uint32_t id = order_.id(i);
      const auto rank = static_cast<std::uint32_t>(i + 1);
      bodies_[rank] = body_of(boxes[id]);
      rank_of_[id] = rank;
      if (!keeps_pairs_) {
        arrays.set(i, boxes[id], id);
        continue;
      }
      fats_[rank] = fat(boxes[id]);
      id_of_[rank] = id;
      arrays.set(i, fats_[rank], rank);
    }
  });
  tree_.load(executor_, ranks);
  for (Scratch& scratch : scratch_) tree_.make_room(scratch.tree);
}

// False, and not all of them, where there are more than `most` pairs.
bool DynamicBvh::search(std::size_t task, Scratch& scratch, std::size_t most,
                        PairBuffer& out) const {
  const std::size_t last = std::min((task + 1) * leaves_a_task, tree_.leaves());
  for (std::size_t leaf = task * leaves_a_task; leaf < last && out.size() <= most; ++leaf) {
    tree_.find_partners(leaf, scratch.tree, scratch.group.work);
    scan_group(tree_.boxes(), tree_.places_of(leaf), tree_.bounds_of_leaf(leaf),
               scratch.tree.partners, scratch.group, out);
  }
  return out.size() <= most;
}

bool DynamicBvh::search_all(std::size_t most_a_task, PairSink& sink) {
  const std::size_t tasks = count_ == 0 ? 0 : block_count(tree_.leaves(), leaves_a_task);
  sink.start(tasks);
  std::atomic<bool> are_all{true};
  const auto body = [&](std::size_t task, int worker) {
    Scratch& scratch = scratch_[static_cast<std::size_t>(worker)];
    if (!search(task, scratch, most_a_task, sink.chunk(task))) are_all = false;
  };
  executor_.run(tasks, std::cref(body));
  return are_all;
}

// False where there are too many of them: in a crowd they are looked for each time.
bool DynamicBvh::keep_pairs() {
  const bool are_all = search_all(leaves_a_task * group_size * most_pairs_a_body, found_);
  if (!are_all || found_.size() > most_pairs) return false;
  const std::size_t count = found_.size();
  ranks_.resize(count);
  pairs_.resize(count);
  meets_.resize(count);
  gone_ = 0;
  are_linked_ = false;
  std::size_t at = 0;
  for (const PairBuffer& chunk : found_.chunks()) {
    std::ranges::copy(chunk.pairs(), ranks_.begin() + static_cast<std::ptrdiff_t>(at));
    at += chunk.size();
  }
  for_each_block(executor_, count, pairs_a_task,
                 [&](std::size_t, std::size_t first, std::size_t last) {
                   for (std::size_t p = first; p < last; ++p) {
                     pairs_[p] = ids_of(ranks_[p]);
                     meets_[p] = meet(bodies_[ranks_[p].a], bodies_[ranks_[p].b]);
                   }
                 });
  return true;
}

// --- some bodies ---

void DynamicBvh::update(const FrameChange& change) {
  if (change.moved.empty() && change.inserted.empty() && change.removed.empty()) return;
  const Motion motion = motion_of(change);
  const std::size_t most = count_ / few;
  const std::size_t churn = change.inserted.size() + change.removed.size();
  const bool is_worn =
      left_ > count_ / 2 || gone_ > pairs_.size() / 2 + count_ || pairs_.size() > most_pairs;
  if (!keeps_pairs_ || is_worn || churn > most) return make_anew(change, motion);
  take_boxes(change);
  if (leavers_.size() > most || !tree_.has_room_for(leavers_.size() + change.inserted.size())) {
    return make_anew(change, motion);
  }
  if (leavers_.size() + churn > 0) change_tree(change);
  test_pairs(change.moved);
  look_anew();
}

void DynamicBvh::take_box(std::uint32_t rank, const Aabb& box) {
  bodies_[rank] = body_of(box);
  is_leaver_[rank] = contains(fats_[rank], box) ? 0 : 1;
}

// Of those that moved; and lists those that are no longer in their fat boxes.
void DynamicBvh::take_boxes(const FrameChange& change) {
  leavers_.clear();
  if (change.moved.size() <= count_ / few) {
    for (const std::uint32_t id : change.moved) {
      const std::uint32_t rank = rank_of_[id];
      take_box(rank, change.boxes[id]);
      if (is_leaver_[rank] != 0) leavers_.push_back(rank);
    }
    return;
  }
  // Most have: all in their order, which is kinder to memory. An empty box, of a body that goes, is
  // within any.
  for_each_block(executor_, bodies_.size() - 1, 4096,
                 [&](std::size_t, std::size_t first, std::size_t last) {
                   for (std::size_t i = first; i < last; ++i) {
                     const auto rank = static_cast<std::uint32_t>(i + 1);
                     const std::uint32_t id = id_of_[rank];
                     if (id != none) take_box(rank, change.boxes[id]);
                   }
                 });
  for (std::uint32_t rank = 1; rank < bodies_.size(); ++rank) {
    if (is_leaver_[rank] != 0) leavers_.push_back(rank);
  }
}

void DynamicBvh::change_tree(const FrameChange& change) {
  link_pairs();
  remove_pairs_of(leavers_);
  for (const std::uint32_t rank : leavers_) {
    fats_[rank] = fat(change.boxes[id_of_[rank]]);
    tree_.move(rank, fats_[rank]);
  }
  moved_.clear();
  for (const std::uint32_t id : change.removed) {
    const std::uint32_t rank = std::exchange(rank_of_[id], 0);
    moved_.push_back(rank);
    bodies_[rank] = bodies_[0];
    id_of_[rank] = none;
    tree_.remove(rank);
  }
  remove_pairs_of(moved_);
  rank_of_.resize(change.boxes.size());
  const std::size_t ranks = bodies_.size() + change.inserted.size();
  tree_.make_room_for_ids(ranks);
  is_leaver_.resize(ranks);
  first_of_.resize(ranks, none);
  for (const std::uint32_t id : change.inserted) {
    const auto rank = static_cast<std::uint32_t>(bodies_.size());
    bodies_.push_back(body_of(change.boxes[id]));
    fats_.push_back(fat(change.boxes[id]));
    id_of_.push_back(id);
    rank_of_[id] = rank;
    is_leaver_[rank] = 1;
    leavers_.push_back(rank);
    tree_.insert(rank, fats_[rank]);
  }
  if (!change.inserted.empty() || !change.removed.empty()) is_sorted_ = false;
  left_ += leavers_.size() + change.removed.size();
  count_ += change.inserted.size();
  count_ -= change.removed.size();
}

void DynamicBvh::link(std::size_t pair) {
  for (const std::size_t side : {0, 1}) {
    std::uint32_t& first = first_of_[side == 0 ? ranks_[pair].a : ranks_[pair].b];
    next_[2 * pair + side] = first;
    first = static_cast<std::uint32_t>(2 * pair + side);
  }
}

void DynamicBvh::link_pairs() {
  if (are_linked_) return;
  are_linked_ = true;
  first_of_.assign(bodies_.size(), none);
  next_.resize(2 * pairs_.size());
  for (std::size_t p = 0; p < pairs_.size(); ++p) link(p);
}

// The lists of all of them are followed side by side, so that they wait for memory together.
void DynamicBvh::list_pairs_of(std::span<const std::uint32_t> ranks) {
  open_.resize(ranks.size() + 1);  // one more is written to
  listed_.clear();
  std::size_t count = 0;
  const auto keep = [&](std::uint32_t at) {
    open_[count] = at;
    count += at != none ? 1 : 0;
  };
  for (const std::uint32_t rank : ranks) keep(first_of_[rank]);
  while (count > 0) {
    const std::size_t before = std::exchange(count, 0);
    for (std::size_t i = 0; i < before; ++i) {
      const std::uint32_t at = open_[i];
      listed_.push_back(at / 2);
      keep(next_[at]);
    }
  }
}

void DynamicBvh::remove_pairs_of(std::span<const std::uint32_t> ranks) {
  list_pairs_of(ranks);
  for (const std::uint32_t p : listed_) {
    gone_ += ranks_[p].a != 0 ? 1 : 0;
    ranks_[p] = {0, 0};
    meets_[p] = 0;
  }
  for (const std::uint32_t rank : ranks) first_of_[rank] = none;
}

// The moved bodies' pairs, or all where these are most.
void DynamicBvh::test_pairs(std::span<const std::uint32_t> moved) {
  const auto test = [&](std::size_t p) {
    meets_[p] = meet(bodies_[ranks_[p].a], bodies_[ranks_[p].b]);
  };
  if (moved.size() > count_ / few) {
    for_each_block(executor_, pairs_.size(), pairs_a_task,
                   [&](std::size_t, std::size_t first, std::size_t last) {
                     for (std::size_t p = first; p < last; ++p) test(p);
                   });
  } else if (!moved.empty()) {
    link_pairs();
    moved_.clear();
    for (const std::uint32_t id : moved) moved_.push_back(rank_of_[id]);
    list_pairs_of(moved_);
    for (const std::uint32_t p : listed_) test(p);
  }
}

// The new pairs of those that have left their boxes; two of them meet once.
void DynamicBvh::look_anew() {
  if (leavers_.empty()) return;
  for (Scratch& scratch : scratch_) tree_.make_room(scratch.tree);
  const std::size_t tasks = block_count(leavers_.size(), bodies_a_task);
  found_.start(tasks);
  const auto look = [&](std::size_t task, int worker) {
    WideTreeScratch& scratch = scratch_[static_cast<std::size_t>(worker)].tree;
    const std::size_t last = std::min((task + 1) * bodies_a_task, leavers_.size());
    for (std::size_t i = task * bodies_a_task; i < last; ++i) {
      const std::uint32_t rank = leavers_[i];
      for (const std::uint32_t other : tree_.find(fats_[rank], scratch)) {
        if (is_leaver_[other] == 0 || rank < other) found_.chunk(task).push(rank, other);
      }
    }
  };
  executor_.run(tasks, std::cref(look));
  for (const std::uint32_t rank : leavers_) is_leaver_[rank] = 0;
  for (const PairBuffer& chunk : found_.chunks()) {
    for (const IndexPair& ranks : chunk.pairs()) {
      ranks_.push_back(ranks);
      pairs_.push_back(ids_of(ranks));
      meets_.push_back(meet(bodies_[ranks.a], bodies_[ranks.b]));
      next_.resize(2 * pairs_.size());
      link(pairs_.size() - 1);
    }
  }
}

// --- the pairs ---

Status DynamicBvh::find_pairs(PairSink& sink) {
  if (!keeps_pairs_) {
    search_all(everything, sink);
    return Status::ok;
  }
  sink.start(block_count(pairs_.size(), pairs_a_task));
  for_each_block(executor_, pairs_.size(), pairs_a_task,
                 [&](std::size_t task, std::size_t first, std::size_t last) {
                   PairBuffer& out = sink.chunk(task);
                   std::size_t count = 0;
                   for (std::size_t p = first; p < last; ++p) count += meets_[p];
                   out.reserve(count + 1);  // one more is written to, and not kept
                   IndexPair* const to = out.end();
                   std::size_t written = 0;
                   for (std::size_t p = first; p < last; ++p) {
                     to[written] = pairs_[p];
                     written += meets_[p];
                   }
                   out.advance(written);
                 });
  return Status::ok;
}

BroadPhaseWork DynamicBvh::work() const {
  Scratch scratch;
  BroadPhaseWork& work = scratch.group.work;
  if (keeps_pairs_) {
    work.candidates = static_cast<std::int64_t>(pairs_.size() - gone_);
    work.box_tests = work.candidates;
  } else if (count_ > 0) {
    tree_.make_room(scratch.tree);
    PairBuffer pairs;
    for (std::size_t task = 0; task < block_count(tree_.leaves(), leaves_a_task); ++task) {
      pairs.clear();
      search(task, scratch, everything, pairs);
    }
  }
  std::size_t found = 0;
  for (const PairBuffer& chunk : found_.chunks()) found += chunk.capacity() * sizeof(IndexPair);
  work.bytes =
      static_cast<std::int64_t>(found) +
      sum_held_bytes(ids_, order_, tree_, bodies_, fats_, id_of_, rank_of_, pairs_, ranks_, meets_,
                     first_of_, next_, open_, listed_, moved_, leavers_, is_leaver_);
  return work;
}

}  // namespace
}  // namespace touchstone

TOUCHSTONE_BROAD_PHASE {
  return {
      {.info = {.name = "dynamic-bvh",
                .citation = "Catto, \"Dynamic Bounding Volume Hierarchies\", GDC 2019; Presson, "
                            "Bullet's btDbvt, 2008; wide nodes, fat pairs kept"},
       .make = [](touchstone::Executor& executor) {
         return std::make_unique<touchstone::DynamicBvh>(executor);
       }}};
}
