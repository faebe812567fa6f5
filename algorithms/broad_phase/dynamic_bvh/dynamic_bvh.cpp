// Dynamic BVH: a BVH over AABBs; moving bodies get enlarged ("fat") boxes. The tree and the list of
// overlapping fat pairs persist between frames; only bodies that leave their fat box are reinserted
// and queried again.
// Paper:   Catto, "Dynamic Bounding Volume Hierarchies", GDC 2019 (only moved bodies query;
//          subtrees that have grown are rebuilt); Presson's btDbvt in Bullet, 2008 (fat boxes,
//          pairs that persist); Rouwe, Jolt's QuadTree, 2021 (wide nodes).
// Steps:   1. Load all boxes into a tree of 16 children a node along a Hilbert curve, and join the
//             tree with itself for all pairs (hilbert_rtree.cpp).
//          2. If a margin can serve all but a sixteenth of the bodies, load fat boxes and keep
//             their pairs (aabb_margin.cpp, pair_cache.cpp); otherwise repeat step 1 in each frame.
//          3. In an update list the leavers: moved bodies outside of their fat boxes.
//          4. If more than a sixteenth of the bodies leave, come or go, adapt the margin and start
//             at step 2.
//          5. Give leavers new fat boxes in the tree, insert and remove bodies, and regroup some
//             of the nodes that this made bad (bvh16_changes.cpp).
//          6. Test the kept pairs of moved bodies on the tight boxes.
//          7. Query the tree for the leavers' partners, and add and remove the pairs in which these
//             differ from the kept ones.
//          8. Write the pairs that overlap, those of some bodies, or those that began or ended
//             since changes were last asked for.
// Departs: nodes have 16 children, see bvh16.h. The margin follows what bodies move in a frame, and
//          is at most a tenth of their size; a body that has not moved yet has none. The whole tree
//          is loaded anew, along a Hilbert curve, only when many bodies leave their boxes at once.
//          In all other frames the work is in proportion to what moved: nodes are mended a few at a
//          time, and neither nodes nor pairs are ever packed.
//          If bodies are too fast for a margin, or crowded, each frame loads the tree without one
//          and searches all pairs.
// Fails:   a body that overlaps most others and moves: all of its pairs are gone through.
// Cost:    O(n + k) expected if most bodies move; O(m log n) and copying the k pairs if m do, or
//          writing the changes alone, for m below n / 5. O(n + k) memory; k = pairs of fat boxes.
//          About 65 bytes a body, 20 more if many move, and 25 a pair.
#include <functional>

#include "algorithms/broad_phase.h"
#include "algorithms/broad_phase/dynamic_bvh/aabb_margin.h"
#include "algorithms/broad_phase/dynamic_bvh/hilbert_rtree.h"
#include "algorithms/broad_phase/dynamic_bvh/pair_cache.h"
#include "algorithms/broad_phase/dynamic_bvh/partner_search.h"
#include "algorithms/core/memory_usage.h"
#include "algorithms/kernels/boxes/aabb_measure.h"

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
  Status find_changes(PairSink& began, PairSink& ended) override;
  Status find_pairs_of(std::span<const std::uint32_t> bodies, PairSink& sink) override;
  BroadPhaseWork work() const override;
  // The nodes with their depths, and the fat boxes below the leaves where pairs of these are kept.
  std::vector<StructureBox> structure() const override {
    return bulk_.tree().structure(how_ != Pairs::searched);
  }

 private:
  static constexpr std::size_t nodes_a_task = 256;
  // If more than this fraction of the bodies (1 / few) leave their boxes, all is made anew.
  static constexpr std::size_t few = 16;
  // If more than this fraction moves, all bodies and pairs are visited in their order.
  static constexpr std::size_t scattered = 5;
  static constexpr std::size_t least_frames = 3;  // least age of a load that pays for its margin
  static constexpr std::size_t most_pairs_a_body = 64;
  static constexpr std::size_t dense_wait = 32;  // frames
  // Bodies and nodes to regroup in a frame: as many as cost little beside the frame's own work.
  static constexpr std::size_t least_regrouped = 256, regrouped_a_change = 4;
  // Bits of a body's state.
  static constexpr std::uint8_t is_leaver = 1;
  static constexpr std::uint8_t is_mover = 2;

  // The source of a frame's pairs: a search of the tree as loaded; such a search, whose pairs are
  // then kept; or the kept pairs.
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
  std::span<const Aabb> boxes_;  // boxes of this frame
  HilbertRTree bulk_;
  AabbMargin margin_;
  Pairs how_ = Pairs::searched;
  PairCache pairs_;
  std::size_t count_ = 0;            // number of bodies
  std::size_t frames_ = 0;           // frames since the tree was loaded
  std::size_t wait_ = 0;             // frames for which pairs are not kept
  std::vector<std::uint8_t> state_;  // indexed by body
  // Bodies that have left their boxes, or are new, in this frame.
  std::vector<std::uint32_t> leavers_;
  PartnerSearch partners_;
  // All pairs of this frame, and those of the last call of find_changes; unless the cache has both.
  PairSink all_;
  PairHistory told_;
  std::size_t placed_ = 0;  // counted for work()
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
  if (how_ == Pairs::kept && pairs_.is_told()) told_.set(pairs_.told());
  how_ = pairs;
  frames_ = 0;
  const bool are_fat = pairs == Pairs::wanted;
  bulk_.load(boxes_, are_fat, [&](std::uint32_t id) {
    return are_fat && state_[id] != 0 ? margin_.around(boxes_[id]) : boxes_[id];
  });
  count_ = bulk_.tree().loaded();
  placed_ = count_;
}

// --- some bodies ---

void DynamicBvh::update(const FrameChange& change) {
  boxes_ = change.boxes;
  placed_ = 0;
  const std::size_t churn = change.inserted.size() + change.removed.size();
  if (change.moved.empty() && churn == 0) {
    // The tree is as it was loaded; kept pairs are still there.
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

// Lists the moved bodies that have left their fat boxes; returns false if they are many.
bool DynamicBvh::list_leavers(std::span<const std::uint32_t> moved) {
  leavers_.clear();
  if (moved.size() <= count_ / scattered) {
    for (const std::uint32_t id : moved) {
      if (!contains(fat_box_of(id), boxes_[id])) leavers_.push_back(id);
    }
  } else {
    mark_leavers();
    for (const std::uint32_t id : moved) {
      if ((state_[id] & is_leaver) != 0) leavers_.push_back(id);
    }
  }
  for (const std::uint32_t id : leavers_) state_[id] = is_mover;
  return leavers_.size() <= count_ / few;
}

// Marks leavers in the order of the tree, which uses the cache better. The empty box of a removed
// body is inside any box, and new bodies are not in the tree yet.
void DynamicBvh::mark_leavers() {
  const Bvh16& tree = bulk_.tree();
  const auto mark = [&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t place = first * Bvh16::fan; place < last * Bvh16::fan; ++place) {
      const std::uint32_t id = tree.boxes().ids()[place];
      if (!tree.is_leaf(place / Bvh16::fan) || id == Bvh16::nobody) continue;
      if (!contains(tree.box_at(place), boxes_[id])) state_[id] |= is_leaver;
    }
  };
  for_each_block(executor_, tree.nodes(), nodes_a_task, mark);
}

void DynamicBvh::change_tree(const FrameChange& change) {
  Bvh16& tree = bulk_.tree();
  pairs_.remove(change.removed);
  for (const std::uint32_t id : leavers_) tree.move(id, margin_.around(boxes_[id]));
  for (const std::uint32_t id : change.removed) tree.remove(id);
  tree.make_room_for_ids(boxes_.size());
  pairs_.make_room_for_ids(boxes_.size());
  state_.resize(boxes_.size());
  for (const std::uint32_t id : change.inserted) {
    state_[id] = is_mover;
    leavers_.push_back(id);
    tree.insert(id, margin_.around(boxes_[id]));
  }
  const std::size_t changes = leavers_.size() + change.removed.size();
  placed_ += changes + tree.rebuild_worn(least_regrouped + regrouped_a_change * changes);
  if (!change.inserted.empty() || !change.removed.empty()) bulk_.change_bodies();
  count_ += change.inserted.size();
  count_ -= change.removed.size();
}

// Finds the leavers' partners, and changes the kept pairs to suit.
void DynamicBvh::look_anew() {
  const auto replace = [&](std::uint32_t leaver, std::span<const std::uint32_t> partners) {
    placed_ += pairs_.replace(leaver, partners, boxes_);
  };
  partners_.find(executor_, bulk_, leavers_, replace);
}

// --- the pairs ---

Status DynamicBvh::find_pairs(PairSink& sink) {
  if (how_ != Pairs::kept) bulk_.find_pairs(sink);
  if (how_ == Pairs::wanted) keep_pairs(sink);
  if (how_ == Pairs::kept) pairs_.write(executor_, sink);
  return Status::ok;
}

// Keeps the sink's pairs, which are of fat boxes; in a crowd there are too many to keep.
void DynamicBvh::keep_pairs(PairSink& sink) {
  const std::size_t count = sink.size();
  if (count > most_pairs_a_body * count_ || count > PairCache::most / 2) {
    wait_ = dense_wait;
    return drop_apart(sink);
  }
  pairs_.refill(executor_, sink, boxes_.size());
  pairs_.test(executor_, boxes_);
  how_ = Pairs::kept;
  placed_ += count;
}

Status DynamicBvh::find_changes(PairSink& began, PairSink& ended) {
  if (how_ == Pairs::kept && pairs_.is_told()) {
    pairs_.write_changes(began, ended);
    return Status::ok;
  }
  find_pairs(all_);
  told_.compare(all_, began, ended);
  if (how_ == Pairs::kept) {
    pairs_.tell();
    all_ = {};
    told_ = {};
  }
  return Status::ok;
}

Status DynamicBvh::find_pairs_of(std::span<const std::uint32_t> bodies, PairSink& sink) {
  if (how_ != Pairs::kept || bodies.size() > count_ / scattered) {
    return BroadPhase::find_pairs_of(bodies, sink);
  }
  pairs_.write_of(bodies, sink);
  return Status::ok;
}

// Removes the pairs whose tight boxes do not overlap.
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
  work.bytes = sum_held_bytes(bulk_, pairs_, state_, leavers_, partners_);
  work.placed = static_cast<std::int64_t>(placed_);
  return work;
}

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<BroadPhaseEntry> broad_phase_dynamic_bvh() {
  return {
      {.info = {.name = "dynamic-bvh",
                .citation = "Catto, \"Dynamic Bounding Volume Hierarchies\", GDC 2019; Presson, "
                            "Bullet's btDbvt, 2008; wide nodes, fat pairs kept"},
       .make = [](Executor& executor) { return std::make_unique<DynamicBvh>(executor); }}};
}

}  // namespace touchstone::entries
