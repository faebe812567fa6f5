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
//          O(n + k) memory; k = pairs of fat boxes. About 45 bytes a body, 20 more where many move,
//          and 17 a pair.
#include <algorithm>

#include "algorithms/broad_phase.h"
#include "algorithms/broad_phase/dynamic_bvh/aabb_margin.h"
#include "algorithms/broad_phase/dynamic_bvh/hilbert_rtree.h"
#include "algorithms/broad_phase/dynamic_bvh/pair_cache.h"
#include "algorithms/core/memory_usage.h"

namespace touchstone {
namespace {

class DynamicBvh final : public BroadPhase {
 public:
  explicit DynamicBvh(Executor& executor) : executor_(executor), bulk_(executor) {}

  void build(std::span<const Aabb> boxes) override {
    boxes_ = boxes;
    bulk_.change_bodies();
    state_.assign(boxes.size(), 0);
    load(Pairs::searched);
  }

  void update(const FrameChange& change) override;
  Status find_pairs(PairSink& sink) override;
  BroadPhaseWork work() const override;

 private:
  static constexpr std::size_t bodies_a_task = 64;
  static constexpr std::size_t nodes_a_task = 256;
  // Of the bodies: if more leave their boxes than this part, all is made anew.
  static constexpr std::size_t few = 16;
  // If more move than this part, all bodies and pairs are gone through in their order.
  static constexpr std::size_t scattered = 5;
  static constexpr std::size_t least_frames = 3;  // that a load is to last
  static constexpr std::size_t most_pairs_a_body = 64;
  static constexpr std::size_t crowd_wait = 32;  // frames
  // Of a body's state.
  static constexpr std::uint8_t is_leaver = 1;
  static constexpr std::uint8_t is_mover = 2;

  // How pairs are had: looked for in a tree as it was loaded; the same, to be kept from then on;
  // or from those that were kept.
  enum class Pairs : std::uint8_t { searched, wanted, kept };

  Aabb fat_box_of(std::uint32_t id) const {
    const Bvh16& tree = bulk_.tree();
    return tree.box_at(tree.place_of(id));
  }

  void make_anew(const FrameChange& change);
  void load(Pairs pairs);
  void keep_pairs(PairSink& sink);
  void drop_apart(PairSink& sink) const;

  bool list_leavers(std::span<const std::uint32_t> moved);
  void mark_leavers();
  void change_tree(const FrameChange& change);
  void look_anew();

  Executor& executor_;
  std::span<const Aabb> boxes_;  // of the frame
  HilbertRTree bulk_;
  AabbMargin margin_;
  Pairs how_ = Pairs::searched;
  PairCache pairs_;
  std::size_t count_ = 0;               // of bodies
  std::size_t frames_ = 0;              // since the tree was loaded
  std::size_t wait_ = 0;                // frames in which pairs are not to be kept
  std::vector<std::uint8_t> state_;     // of each body
  std::vector<std::uint32_t> leavers_;  // that have left their boxes, or are new, in this frame
  PairSink found_;                      // by them
};

// --- all bodies ---

void DynamicBvh::make_anew(const FrameChange& change) {
  const std::size_t churn = change.inserted.size() + change.removed.size();
  const std::size_t most = count_ / few;
  bool keep = wait_ == 0 && churn <= most;
  wait_ -= wait_ > 0 ? 1 : 0;
  if (how_ == Pairs::searched) {
    keep &= margin_.measure(boxes_, change.moved, bulk_.tree()) + churn <= most;
  } else {
    keep &= frames_ >= least_frames;
    margin_.adapt(frames_);
  }
  state_.resize(boxes_.size());
  for (const std::uint32_t id : change.moved) state_[id] = is_mover;
  if (churn > 0) bulk_.change_bodies();
  load(keep ? Pairs::wanted : Pairs::searched);
  if (keep && change.moved.size() <= most) bulk_.forget_order();
}

void DynamicBvh::load(Pairs pairs) {
  how_ = pairs;
  frames_ = 0;
  const bool are_fat = pairs == Pairs::wanted;
  bulk_.load(boxes_, are_fat, [&](std::uint32_t id) {
    return are_fat && state_[id] != 0 ? margin_.around(boxes_[id]) : boxes_[id];
  });
  count_ = bulk_.tree().loaded();
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
  margin_.widen(boxes_, change.moved.size(), leavers_, bulk_.tree());
  if (leavers_.size() + churn > 0) change_tree(change);
  if (change.moved.size() > count_ / scattered) {
    pairs_.test(executor_, boxes_);
  } else {
    pairs_.test(change.moved, boxes_);
  }
  look_anew();
}

// Those that moved and are no longer in their fat boxes; false where they are many.
bool DynamicBvh::list_leavers(std::span<const std::uint32_t> moved) {
  leavers_.clear();
  if (moved.size() <= count_ / scattered) {
    for (const std::uint32_t id : moved) {
      if (!AabbMargin::holds(fat_box_of(id), boxes_[id])) leavers_.push_back(id);
    }
  } else {
    mark_leavers();
    for (const std::uint32_t id : moved) {
      if ((state_[id] & is_leaver) != 0) leavers_.push_back(id);
    }
  }
  for (const std::uint32_t id : leavers_) state_[id] = is_mover | is_leaver;
  return leavers_.size() <= count_ / few;
}

// All in the order of the tree, which is kinder to memory. An empty box, of a body that goes, is
// within any; and new bodies are not there yet.
void DynamicBvh::mark_leavers() {
  const Bvh16& tree = bulk_.tree();
  const auto mark = [&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t place = first * Bvh16::fan; place < last * Bvh16::fan; ++place) {
      const std::uint32_t id = tree.boxes().ids()[place];
      if (!tree.is_leaf(place / Bvh16::fan) || id == Bvh16::nobody) continue;
      if (!AabbMargin::holds(tree.box_at(place), boxes_[id])) state_[id] |= is_leaver;
    }
  };
  for_each_block(executor_, tree.nodes(), nodes_a_task, mark);
}

void DynamicBvh::change_tree(const FrameChange& change) {
  Bvh16& tree = bulk_.tree();
  pairs_.remove(leavers_);
  pairs_.remove(change.removed);
  for (const std::uint32_t id : leavers_) tree.move(id, margin_.around(boxes_[id]));
  for (const std::uint32_t id : change.removed) tree.remove(id);
  tree.make_room_for_ids(boxes_.size());
  pairs_.make_room_for_ids(boxes_.size());
  state_.resize(boxes_.size());
  for (const std::uint32_t id : change.inserted) {
    state_[id] = is_mover | is_leaver;
    leavers_.push_back(id);
    tree.insert(id, margin_.around(boxes_[id]));
  }
  tree.rebuild_worn();
  if (!change.inserted.empty() || !change.removed.empty()) bulk_.change_bodies();
  count_ += change.inserted.size();
  count_ -= change.removed.size();
}

// The new pairs of those that have left their boxes; two of them meet once.
void DynamicBvh::look_anew() {
  const std::size_t tasks = block_count(leavers_.size(), bodies_a_task);
  found_.start(tasks);
  const auto look = [&](std::size_t task, int worker) {
    Bvh16Scratch& scratch = bulk_.scratch(worker);
    const std::size_t last = std::min((task + 1) * bodies_a_task, leavers_.size());
    for (std::size_t i = task * bodies_a_task; i < last; ++i) {
      const std::uint32_t id = leavers_[i];
      for (const std::uint32_t other : bulk_.tree().find(fat_box_of(id), scratch)) {
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
  if (how_ != Pairs::kept) bulk_.find_pairs(sink);
  if (how_ == Pairs::wanted) keep_pairs(sink);
  if (how_ == Pairs::kept) pairs_.write(executor_, sink);
  return Status::ok;
}

// Of the sink, in which pairs of fat boxes are; but in a crowd they are looked for each time.
void DynamicBvh::keep_pairs(PairSink& sink) {
  const std::size_t count = sink.size();
  if (count > most_pairs_a_body * count_ || count > PairCache::most / 2) {
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
  BroadPhaseWork work{.box_tests = 0, .node_visits = 0, .candidates = 0};
  if (how_ == Pairs::kept) {
    work.candidates = static_cast<std::int64_t>(pairs_.size());
    work.box_tests = work.candidates;
  } else {
    work = bulk_.work();
  }
  work.bytes = sum_held_bytes(bulk_, pairs_, state_, leavers_, found_);
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
