// Dynamic BVH: a tree of boxes, those of bodies that move a little larger than these, and the pairs
// of those that overlap; a body that stays in its fat box changes neither, and only others look
// anew.
// Paper:   Catto, "Dynamic Bounding Volume Hierarchies", GDC 2019 (only what moved asks; subtrees
//          that have grown are rebuilt); Presson's btDbvt in Bullet, 2008 (fat boxes, pairs that
//          persist); Rouwe, Jolt's QuadTree, 2021 (wide nodes).
// Departs: nodes have 16 children, see kernels/wide_tree.h. The margin follows what bodies move a
//          frame, and is at most a tenth of their size; who has not moved yet has none. Only when
//          many leave their boxes at once is the whole tree loaded anew, along a Hilbert curve.
//          Where bodies are too fast for a margin, or crowded, that is done each frame without one,
//          and pairs are not kept but looked for.
// Fails:   a body that overlaps most others and moves: its pairs are all made anew.
// Cost:    O(n + k) to be expected where most move; O(m log n) and copying the k pairs where m do.
//          O(n + k) memory; k = pairs of fat boxes. About 45 bytes a body, 16 more where many move,
//          and 17 a pair.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "algorithms/broad_phase.h"
#include "algorithms/kernels/curve_keys.h"
#include "algorithms/kernels/group_scan.h"
#include "algorithms/kernels/held_bytes.h"
#include "algorithms/kernels/kept_pairs.h"
#include "algorithms/kernels/wide_tree.h"

namespace touchstone {
namespace {

class DynamicBvh final : public BroadPhase {
 public:
  explicit DynamicBvh(Executor& executor)
      : executor_(executor), scratch_(static_cast<std::size_t>(executor.width())) {}

  void build(std::span<const Aabb> boxes) override {
    boxes_ = boxes;
    is_sorted_ = false;
    state_.assign(boxes.size(), 0);
    load(Pairs::searched);
  }

  void update(const FrameChange& change) override;
  Status find_pairs(PairSink& sink) override;
  BroadPhaseWork work() const override;

 private:
  static constexpr std::size_t leaves_a_task = 32;
  static constexpr std::size_t bodies_a_task = 64;
  static constexpr std::size_t nodes_a_task = 256;
  // Of the bodies: if more leave their boxes than that, all is made anew.
  static constexpr std::size_t few = 16;
  static constexpr float most_margin = 0.1f;  // of a body's longest side
  static constexpr float frames_ahead = 8;
  static constexpr std::size_t least_frames = 3;  // that a load is to last
  static constexpr std::size_t most_pairs_a_body = 64;
  static constexpr std::size_t crowd_wait = 32;  // frames
  static constexpr std::size_t sample_size = 256;
  // Of a body's state.
  static constexpr std::uint8_t is_leaver = 1;
  static constexpr std::uint8_t is_mover = 2;

  // How pairs are had: looked for in a tree as it was loaded; the same, to be kept from then on;
  // or from those that were kept.
  enum class Pairs : std::uint8_t { searched, wanted, kept };
  struct Scratch {
    WideTreeScratch tree;
    GroupScratch group;
  };
  struct Motion {
    float usual = 0;       // what nine in ten move, of those that a margin can serve
    std::size_t fast = 0;  // bodies that leave any margin within four frames
  };

  static float longest_side(const Aabb& box) {
    return std::max({box.max[0] - box.min[0], box.max[1] - box.min[1], box.max[2] - box.min[2]});
  }
  static bool contains(const Aabb& outer, const Aabb& inner) {
    bool within = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      within &= outer.min[axis] <= inner.min[axis] && inner.max[axis] <= outer.max[axis];
    }
    return within;
  }
  // The most that a side of the one lies off the same side of the other.
  static float distance(const Aabb& a, const Aabb& b) {
    float most = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      most = std::max(
          {most, std::abs(a.min[axis] - b.min[axis]), std::abs(a.max[axis] - b.max[axis])});
    }
    return most;
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
  Aabb fat_box_of(std::uint32_t id) const { return tree_.box_at(tree_.place_of(id)); }

  Motion motion_of(std::span<const std::uint32_t> moved) const;
  void make_anew(const FrameChange& change);
  void load(Pairs pairs);
  void fill_tree();
  void search(std::size_t task, Scratch& scratch, PairBuffer& out) const;
  void search_all(PairSink& sink);
  void keep_pairs(PairSink& sink);
  void drop_apart(PairSink& sink) const;

  bool list_leavers(std::span<const std::uint32_t> moved);
  void follow_motion(std::size_t moved);
  void change_tree(const FrameChange& change);
  void look_anew();

  Executor& executor_;
  std::vector<Scratch> scratch_;
  std::span<const Aabb> boxes_;  // of the frame
  std::vector<std::uint32_t> ids_;
  CurveKeys order_;
  bool is_sorted_ = false;     // the order is of the bodies that are there
  double spread_at_sort_ = 0;  // of the tree's leaves
  WideTree tree_;
  float margin_ = 0;
  std::size_t count_ = 0;   // of bodies
  std::size_t frames_ = 0;  // since the tree was loaded
  std::size_t wait_ = 0;    // frames in which pairs are not to be kept
  Pairs how_ = Pairs::searched;
  KeptPairs pairs_;
  std::vector<std::uint8_t> state_;     // of each body
  std::vector<std::uint32_t> leavers_;  // that have left their boxes, or are new, in this frame
  PairSink found_;                      // by them
};

// --- all bodies ---

// From a sample of those that moved; the tree is of the boxes before.
DynamicBvh::Motion DynamicBvh::motion_of(std::span<const std::uint32_t> moved) const {
  Motion motion;
  const std::size_t count = std::min(moved.size(), sample_size);
  std::array<float, sample_size> slow;
  std::size_t slow_count = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t id = moved[i * moved.size() / count];
    const float way = distance(boxes_[id], fat_box_of(id));
    if (way <= 0.25f * most_margin * longest_side(boxes_[id])) slow[slow_count++] = way;
  }
  if (count > 0) motion.fast = (count - slow_count) * moved.size() / count;
  if (slow_count > 0) {
    const auto at = slow.begin() + static_cast<std::ptrdiff_t>((slow_count - 1) * 9 / 10);
    std::nth_element(slow.begin(), at, slow.begin() + static_cast<std::ptrdiff_t>(slow_count));
    motion.usual = *at;
  }
  return motion;
}

void DynamicBvh::make_anew(const FrameChange& change) {
  const std::size_t churn = change.inserted.size() + change.removed.size();
  const std::size_t most = count_ / few;
  bool keep = wait_ == 0 && churn <= most;
  wait_ -= wait_ > 0 ? 1 : 0;
  if (how_ == Pairs::searched) {
    const Motion motion = motion_of(change.moved);
    keep &= motion.fast + churn <= most;
    margin_ = frames_ahead * motion.usual;
  } else {
    // As long as it lasted, it was wide enough for.
    keep &= frames_ >= least_frames;
    margin_ *= std::clamp(frames_ahead / static_cast<float>(frames_ + 1), 0.5f, 2.0f);
  }
  state_.resize(boxes_.size());
  for (const std::uint32_t id : change.moved) state_[id] = is_mover;
  if (churn > 0) is_sorted_ = false;
  load(keep ? Pairs::wanted : Pairs::searched);
  if (!keep || change.moved.size() > most) return;
  // There will be no need for it soon.
  is_sorted_ = false;
  order_ = {};
  ids_ = {};
}

void DynamicBvh::load(Pairs pairs) {
  how_ = pairs;
  frames_ = 0;
  const bool was_sorted = is_sorted_;
  if (!was_sorted) {
    list_bodies(executor_, boxes_, ids_);
    order_.sort(executor_, boxes_, ids_);
  }
  fill_tree();
  // Written so that a NaN, of bounds that overflow, makes a new order.
  if (was_sorted && !(tree_.spread() <= 1.25 * spread_at_sort_)) {
    list_bodies(executor_, boxes_, ids_);
    order_.sort(executor_, boxes_, ids_);
    fill_tree();
    is_sorted_ = false;
  }
  if (!is_sorted_) spread_at_sort_ = tree_.spread();
  is_sorted_ = true;
}

void DynamicBvh::fill_tree() {
  count_ = order_.size();
  const bool are_fat = how_ == Pairs::wanted;
  tree_.start(count_, boxes_.size());
  for_each_block(executor_, count_, 4096, [&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const std::uint32_t id = order_.id(i);
      const bool is_fat = are_fat && state_[id] != 0;
      tree_.set(i, is_fat ? fat(boxes_[id]) : boxes_[id], id);
    }
  });
  tree_.load(executor_, are_fat);
  for (Scratch& scratch : scratch_) tree_.make_room(scratch.tree);
}

void DynamicBvh::search(std::size_t task, Scratch& scratch, PairBuffer& out) const {
  const std::size_t last = std::min((task + 1) * leaves_a_task, tree_.leaves());
  for (std::size_t leaf = task * leaves_a_task; leaf < last; ++leaf) {
    tree_.find_partners(leaf, scratch.tree, scratch.group.work);
    scan_group(tree_.boxes(), tree_.places_of(leaf), tree_.bounds_of_leaf(leaf),
               scratch.tree.partners, scratch.group, out);
  }
}

void DynamicBvh::search_all(PairSink& sink) {
  const std::size_t tasks = count_ == 0 ? 0 : block_count(tree_.leaves(), leaves_a_task);
  sink.start(tasks);
  const auto body = [&](std::size_t task, int worker) {
    search(task, scratch_[static_cast<std::size_t>(worker)], sink.chunk(task));
  };
  executor_.run(tasks, std::cref(body));
}

// --- some bodies ---

void DynamicBvh::update(const FrameChange& change) {
  boxes_ = change.boxes;
  const std::size_t churn = change.inserted.size() + change.removed.size();
  if (change.moved.empty() && churn == 0) {
    // The tree is as it was loaded; whoever keeps pairs has them.
    if (how_ == Pairs::searched && wait_ == 0) make_anew(change);
    return;
  }
  if (how_ != Pairs::kept || churn > count_ / few || !list_leavers(change.moved)) {
    return make_anew(change);
  }
  ++frames_;
  follow_motion(change.moved.size());
  if (leavers_.size() + churn > 0) change_tree(change);
  if (change.moved.size() > count_ / few) {
    pairs_.test(executor_, boxes_);
  } else {
    pairs_.test(change.moved, boxes_);
  }
  look_anew();
}

// Those that moved and are no longer in their fat boxes; false where they are many.
bool DynamicBvh::list_leavers(std::span<const std::uint32_t> moved) {
  leavers_.clear();
  const std::size_t most = count_ / few;
  if (moved.size() <= most) {
    for (const std::uint32_t id : moved) {
      if (!contains(fat_box_of(id), boxes_[id])) leavers_.push_back(id);
    }
  } else {
    // All in the order of the tree, which is kinder to memory. An empty box, of a body that goes,
    // is within any; and new bodies are not in it yet.
    const std::uint32_t* const ids = tree_.boxes().ids();
    const auto mark = [&](std::size_t, std::size_t first, std::size_t last) {
      for (std::size_t node = first; node < last; ++node) {
        if (!tree_.is_leaf(node)) continue;
        for (std::size_t place = node * WideTree::fan; place < (node + 1) * WideTree::fan;
             ++place) {
          const std::uint32_t id = ids[place];
          if (id == WideTree::nobody || contains(tree_.box_at(place), boxes_[id])) continue;
          state_[id] |= is_leaver;
        }
      }
    };
    for_each_block(executor_, tree_.nodes(), nodes_a_task, mark);
    for (const std::uint32_t id : moved) {
      if ((state_[id] & is_leaver) != 0) leavers_.push_back(id);
    }
  }
  for (const std::uint32_t id : leavers_) state_[id] = is_mover | is_leaver;
  return leavers_.size() <= most;
}

// Where many of those that move leave their boxes, the margin is too small: what they are outside
// by is no more than their way.
void DynamicBvh::follow_motion(std::size_t moved) {
  if (leavers_.empty() || 4 * leavers_.size() < moved) return;
  std::array<float, sample_size> ways{};
  const std::size_t count = std::min(leavers_.size(), sample_size);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t id = leavers_[i * leavers_.size() / count];
    const Aabb then = fat_box_of(id);
    const Aabb& now = boxes_[id];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      ways[i] = std::max({ways[i], then.min[axis] - now.min[axis], now.max[axis] - then.max[axis]});
    }
  }
  const auto middle = ways.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(ways.begin(), middle, ways.begin() + static_cast<std::ptrdiff_t>(count));
  margin_ = std::max(margin_, frames_ahead * *middle);
}

void DynamicBvh::change_tree(const FrameChange& change) {
  pairs_.remove(leavers_);
  pairs_.remove(change.removed);
  for (const std::uint32_t id : leavers_) tree_.move(id, fat(boxes_[id]));
  for (const std::uint32_t id : change.removed) tree_.remove(id);
  tree_.make_room_for_ids(boxes_.size());
  pairs_.make_room_for_ids(boxes_.size());
  state_.resize(boxes_.size());
  for (const std::uint32_t id : change.inserted) {
    state_[id] = is_mover | is_leaver;
    leavers_.push_back(id);
    tree_.insert(id, fat(boxes_[id]));
  }
  tree_.rebuild_worn();
  if (!change.inserted.empty() || !change.removed.empty()) is_sorted_ = false;
  count_ += change.inserted.size();
  count_ -= change.removed.size();
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
      const std::uint32_t id = leavers_[i];
      for (const std::uint32_t other : tree_.find(fat_box_of(id), scratch)) {
        if ((state_[other] & is_leaver) == 0 || id < other) found_.chunk(task).push(id, other);
      }
    }
  };
  executor_.run(tasks, std::cref(look));
  for (const std::uint32_t id : leavers_) state_[id] = is_mover;
  for (const PairBuffer& chunk : found_.chunks()) {
    for (const IndexPair& pair : chunk.pairs()) pairs_.add(pair, boxes_);
  }
}

// --- the pairs ---

Status DynamicBvh::find_pairs(PairSink& sink) {
  if (how_ != Pairs::kept) search_all(sink);
  if (how_ == Pairs::wanted) keep_pairs(sink);
  if (how_ == Pairs::kept) pairs_.write(executor_, sink);
  return Status::ok;
}

// Of the sink, in which pairs of fat boxes are; but in a crowd they are looked for each time.
void DynamicBvh::keep_pairs(PairSink& sink) {
  const std::size_t count = sink.size();
  if (count > most_pairs_a_body * count_ || count > KeptPairs::most / 2) {
    wait_ = crowd_wait;
    return drop_apart(sink);
  }
  pairs_.refill(executor_, sink, boxes_.size());
  pairs_.test(executor_, boxes_);
  how_ = Pairs::kept;
}

// Pairs of which only the fat boxes overlap.
void DynamicBvh::drop_apart(PairSink& sink) const {
  const auto task = [&](std::size_t i, int) {
    PairBuffer& chunk = sink.chunk(i);
    const std::span<const IndexPair> pairs = chunk.pairs();
    chunk.clear();
    for (const IndexPair pair : pairs) {
      if (overlap(boxes_[pair.a], boxes_[pair.b])) chunk.push(pair.a, pair.b);
    }
  };
  executor_.run(sink.chunks().size(), std::cref(task));
}

BroadPhaseWork DynamicBvh::work() const {
  Scratch scratch;
  BroadPhaseWork& work = scratch.group.work;
  if (how_ == Pairs::kept) {
    work.candidates = static_cast<std::int64_t>(pairs_.size());
    work.box_tests = work.candidates;
  } else if (count_ > 0) {
    tree_.make_room(scratch.tree);
    PairBuffer pairs;
    for (std::size_t task = 0; task < block_count(tree_.leaves(), leaves_a_task); ++task) {
      pairs.clear();
      search(task, scratch, pairs);
    }
  }
  work.bytes = sum_held_bytes(ids_, order_, tree_, pairs_, state_, leavers_, found_);
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
