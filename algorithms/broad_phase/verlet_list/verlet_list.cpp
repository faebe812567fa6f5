// Verlet list: list the pairs whose slightly grown boxes overlap, and test only these until a body
// has moved too far.
// Paper:   Verlet, "Computer 'Experiments' on Classical Fluids. I", Physical Review 159, 1967
//          (neighbour lists); the search is the packed R-tree's (kernels/bvh/implicit_rtree.h).
// Steps:   1. Measure how far bodies move in a frame, from a sample (box_motion.cpp). While there is no
//             list, the R-tree has the boxes of the frame before, and up to fifteen frames go without
//             the measurement.
//          2. Choose for how many frames a list is cheapest (rebuild_interval.cpp). If for none,
//             search the boxes of this frame with the packed R-tree, and end.
//          3. Grow each box by its motion in that many frames, and list all pairs of grown boxes
//             that overlap, with the packed R-tree.
//          4. In each frame find the escaped boxes: those outside of their grown ones, and new
//             ones (escaped_boxes.cpp). If they are too many, start at step 1.
//          5. Test the listed pairs of bodies that have not escaped (pair_tests.h).
//          6. Search the R-tree for each escaped box, and test escaped boxes against each other.
// Departs: each box grows by an amount that follows its own motion. Counts, not times, decide how
//          many frames a list lasts, so that making and testing it cost least together. The order
//          of the R-tree is kept until its blocks have grown by a quarter. Escaped boxes are searched
//          one by one while they are few. If motion is too fast for a list, the packed R-tree
//          searches each frame.
// Fails:   motion of a body's size a frame, or, with AVX2 or AVX-512, more than some two pairs a body
//          that move: it is then the packed R-tree. Bodies that slow down get their list some frames late.
// Cost:    O(n + c) a frame, c = pairs of grown boxes; O(n) expected to make the list. About 80
//          bytes a body and 12 a candidate.
#include <algorithm>
#include <cstdint>
#include <functional>

#include "algorithms/broad_phase.h"
#include "algorithms/broad_phase/verlet_list/box_motion.h"
#include "algorithms/broad_phase/verlet_list/escaped_boxes.h"
#include "algorithms/broad_phase/verlet_list/pair_tests.h"
#include "algorithms/broad_phase/verlet_list/rebuild_interval.h"
#include "algorithms/core/executor/parallel_blocks.h"
#include "algorithms/core/memory_usage.h"
#include "algorithms/kernels/bvh/hilbert_sort.h"
#include "algorithms/kernels/bvh/implicit_rtree.h"

namespace touchstone {
namespace {

class VerletList final : public BroadPhase {
 public:
  explicit VerletList(Executor& executor)
      : executor_(executor), scratch_(static_cast<std::size_t>(executor.width())) {}

  void build(std::span<const Aabb> boxes) override {
    boxes_ = boxes;
    is_ordered_ = false;
    until_look_ = wait_ = 1;
    asks_for_all_ = true;
    search_anew();
  }

  void update(const FrameChange& change) override;
  Status find_pairs(PairSink& sink) override;
  Status find_pairs_of(std::span<const std::uint32_t> bodies, PairSink& sink) override;
  BroadPhaseWork work() const override;
  std::vector<StructureBox> structure() const override;

 private:
  static constexpr std::size_t block_size = 1024;
  static constexpr std::size_t groups_a_task = 2;
  static constexpr std::size_t escaped_a_task = 32;
  static constexpr int most_wait = 16;         // frames
  static constexpr double most_spread = 1.25;  // growth of the blocks with which an order is kept

  // Loads the tree with these boxes, in the order of earlier ones while that is good.
  void load(std::span<const Aabb> boxes) {
    if (is_ordered_) {
      fit(boxes);
      const double now = tree_.spread();
      // The negation makes a NaN, from bounds that overflow, rebuild the order.
      if (now <= most_spread * spread_) {
        spread_ = std::min(now, spread_);
        return;
      }
    }
    order_.make(executor_, boxes);
    fit(boxes);
    spread_ = tree_.spread();
    is_ordered_ = true;
  }
  void fit(std::span<const Aabb> boxes) {
    if (order_.empty()) return;
    tree_.fit(executor_, order_.places(), [&](std::size_t first, std::size_t last) {
      order_.gather(boxes, first, last, tree_.boxes());
    });
  }
  std::size_t groups() const { return order_.empty() ? 0 : tree_.groups(); }

  void search_anew() {
    load(boxes_);
    listed_ = false;
  }
  // The same where the tree is over the boxes of the frame before.
  void search_again(const FrameChange& change) {
    if (is_ordered_ && change.moved.empty()) return;
    search_anew();
  }
  void recall_boxes();
  double choose_frames(const MeanMotion& motion) {
    return asks_for_all_ && !order_.empty() ? interval_.choose(motion, boxes_.size(), pairs_) : 0;
  }
  void make_list(const MeanMotion& motion, double frames);
  void search_all(PairSink& sink);

  Executor& executor_;
  std::vector<RTreeScratch> scratch_;
  std::span<const Aabb> boxes_;  // boxes of this frame
  HilbertSort order_;
  bool is_ordered_ = false;  // the order has all bodies that there are
  double spread_ = 0;        // least spread of the blocks since the order was made
  ImplicitRTree tree_;       // over the grown boxes while there is a list, else over this frame's

  std::vector<Aabb> reference_;  // grown boxes of the list; indexed by body
  int age_ = 0;                  // frames since the list was made
  bool listed_ = false;
  PairSink candidates_;
  RebuildInterval interval_;
  int until_look_ = 1, wait_ = 1;  // frames until motion is measured, while there is no list
  bool asks_for_all_ = true;       // the last question was for all pairs, or almost all

  EscapedBoxes escaped_;   // those of the list
  std::size_t pairs_ = 0;  // number found by the last search for all
  BodyMarks asked_;        // scratch
};

// Writes the boxes of the frame before, which the tree holds while there is no list.
void VerletList::recall_boxes() {
  if (order_.size() < boxes_.size()) reference_.assign(boxes_.size(), Aabb::empty());
  reference_.resize(boxes_.size());
  const AabbSoA& then = tree_.boxes();
  for_each_block(executor_, order_.empty() ? 0 : then.size(), block_size,
                 [&](std::size_t, std::size_t first, std::size_t last) {
                   for (std::size_t i = first; i < last; ++i) {
                     const Aabb box = then.box(i);
                     if (!box.is_empty()) reference_[then.ids()[i]] = box;
                   }
                 });
}

// Makes a list for this many frames; `reference_` holds the boxes of `age_` frames ago.
void VerletList::make_list(const MeanMotion& motion, double frames) {
  grow_boxes(executor_, boxes_, reference_, age_, frames, motion);
  age_ = 0;
  load(reference_);
  listed_ = !order_.empty();
  if (!listed_) return;
  search_all(candidates_);
  escaped_.start(boxes_.size());
  interval_.made(motion, frames, boxes_.size(), candidates_.size());
}

void VerletList::search_all(PairSink& sink) {
  search_groups(executor_, groups(), groups_a_task, scratch_, sink,
                std::bind_front(pair_group, std::cref(tree_)));
}

void VerletList::update(const FrameChange& change) {
  boxes_ = change.boxes;
  if (!change.inserted.empty() || !change.removed.empty()) is_ordered_ = false;
  MeanMotion motion;
  if (listed_) {
    ++age_;
    if (escaped_.add(executor_, change, reference_)) return;
    interval_.ended(age_, boxes_.size(), pairs_);
    motion = mean_motion(reference_, boxes_, age_);
  } else {
    if (--until_look_ > 0) return search_again(change);
    if (!order_.empty()) motion = mean_motion(tree_.boxes(), boxes_);
  }
  const double frames = choose_frames(motion);
  if (frames == 0) {
    wait_ = std::min(2 * wait_, most_wait);
    until_look_ = wait_;
    return listed_ ? search_anew() : search_again(change);
  }
  wait_ = until_look_ = 1;
  if (!listed_) {
    recall_boxes();
    age_ = 1;
  }
  make_list(motion, frames);
}

Status VerletList::find_pairs(PairSink& sink) {
  asks_for_all_ = true;
  if (!listed_) {
    search_all(sink);
    pairs_ = sink.size();
    return Status::ok;
  }
  const std::span<const PairBuffer> candidates = candidates_.chunks();
  const std::size_t escaped_tasks = block_count(escaped_.size(), escaped_a_task);
  sink.start(candidates.size() + escaped_tasks);
  const auto do_task = [&](std::size_t task, int worker) {
    PairBuffer& out = sink.chunk(task);
    if (task >= candidates.size()) {
      const std::size_t first = (task - candidates.size()) * escaped_a_task;
      const std::size_t last = std::min(first + escaped_a_task, escaped_.size());
      escaped_.search(tree_, boxes_, first, last, scratch_[static_cast<std::size_t>(worker)], out);
    } else if (escaped_.size() == 0) {
      write_overlapping(
          boxes_, candidates[task].pairs(), [](IndexPair) { return true; }, out);
    } else {
      const auto stayed = [&](IndexPair pair) { return !escaped_.has_either(pair); };
      write_overlapping(boxes_, candidates[task].pairs(), stayed, out);
    }
  };
  executor_.run(candidates.size() + escaped_tasks, std::cref(do_task));
  pairs_ = sink.size();
  return Status::ok;
}

Status VerletList::find_pairs_of(std::span<const std::uint32_t> bodies, PairSink& sink) {
  const bool few = are_few(bodies.size(), boxes_.size());
  if (listed_ || !few || order_.empty()) return BroadPhase::find_pairs_of(bodies, sink);
  if (!bodies.empty()) asks_for_all_ = false;
  asked_.set(bodies);
  search_bodies(executor_, tree_, boxes_, bodies, asked_, scratch_, sink);
  return Status::ok;
}

BroadPhaseWork VerletList::work() const {
  RTreeScratch scratch;
  PairBuffer pairs;
  std::size_t listed = 0;
  if (listed_) {
    for (const PairBuffer& chunk : candidates_.chunks()) listed += chunk.size();
    escaped_.search(tree_, boxes_, 0, escaped_.size(), scratch, pairs);
    const std::size_t among =
        escaped_.size() * (escaped_.size() - std::min<std::size_t>(1, escaped_.size())) / 2;
    listed += among;
    scratch.work.box_tests += scratch.work.candidates + static_cast<std::int64_t>(listed);
    scratch.work.candidates += static_cast<std::int64_t>(listed);
  } else {
    count_groups(groups(), scratch, std::bind_front(pair_group, std::cref(tree_)));
  }
  scratch.work.bytes = sum_held_bytes(order_, tree_, reference_, escaped_, candidates_);
  return scratch.work;
}

// Shows the grown boxes while there is a list, with the own boxes of bodies that have escaped, and
// otherwise the nodes of the R-tree with their depths.
std::vector<StructureBox> VerletList::structure() const {
  if (!listed_) return order_.empty() ? std::vector<StructureBox>{} : tree_.structure();
  std::vector<StructureBox> grown;
  for (std::size_t id = 0; id < boxes_.size(); ++id) {
    if (boxes_[id].is_empty()) continue;
    grown.push_back({escaped_.has(id) ? boxes_[id] : reference_[id]});
  }
  return grown;
}

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<BroadPhaseEntry> broad_phase_verlet_list() {
  return {
      {.info = {.name = "verlet-list",
                .citation = "Verlet, \"Computer 'Experiments' on Classical Fluids. I\", Physical "
                            "Review 159, 1967; over a packed R-tree"},
       .make = [](Executor& executor) { return std::make_unique<VerletList>(executor); }}};
}

}  // namespace touchstone::entries
