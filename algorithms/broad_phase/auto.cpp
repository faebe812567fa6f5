// Auto: the packed R-tree, the Verlet list or the dynamic BVH, whichever suits the frames that come.
// Paper:   Rice, "The Algorithm Selection Problem", Advances in Computers 15, 1976.
// Steps:   1. Start with the packed R-tree, which needs no earlier frame.
//          2. In each update count the bodies that moved, came or went, and take the pairs of the
//             frame before.
//          3. Few changes want the dynamic BVH. Otherwise more than 400,000 bodies want the packed
//             R-tree, as do those that have many pairs, but for 4,000 to 50,000; the rest want the
//             Verlet list.
//          4. When another one has been wanted for some frames in a row, build it with this frame's
//             boxes, and drop the one before. The first frame after a build suffices.
// Departs: it decides by counts and not by times, so that the order of the pairs does not depend on
//          the machine or its load. Each change of mind doubles the number of frames that the next
//          one takes, until the next build. Thresholds are measured.
// Fails:   bodies that rest for some frames and then move for some: it follows late, and builds
//          anew each time.
// Cost:    that of the one chosen, and a build at each change of mind.
#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "algorithms/broad_phase.h"
#include "algorithms/core/memory_usage.h"
#include "algorithms/core/pair_history.h"

namespace touchstone::entries {

std::vector<BroadPhaseEntry> broad_phase_packed_rtree();
std::vector<BroadPhaseEntry> broad_phase_verlet_list();
std::vector<BroadPhaseEntry> broad_phase_dynamic_bvh();

}  // namespace touchstone::entries

namespace touchstone {
namespace {

enum class Kind : std::uint8_t { packed_rtree, verlet_list, dynamic_bvh };

std::unique_ptr<BroadPhase> make(Kind kind, Executor& executor) {
  switch (kind) {
    case Kind::verlet_list: return entries::broad_phase_verlet_list()[0].make(executor);
    case Kind::dynamic_bvh: return entries::broad_phase_dynamic_bvh()[0].make(executor);
    default: return entries::broad_phase_packed_rtree()[0].make(executor);
  }
}

// What was asked and found in the last frame.
struct Answers {
  std::optional<std::size_t> pairs;  // their number; empty: not known
  bool are_changes = false;          // find_changes has been called
};

// The counts of the frames, and what they speak for.
class Choice {
 public:
  Choice() = default;
  Choice(Kind kind, std::size_t bodies) : kind_(kind), bodies_(bodies) {}
  Kind kind() const { return kind_; }

  // Returns true if another kind is to take over with this frame.
  bool update(const FrameChange& change, const Answers& answers) {
    bodies_ += change.inserted.size();
    bodies_ -= change.removed.size();
    const Kind wanted =
        wants(change.moved.size() + change.inserted.size() + change.removed.size(), answers);
    wanted_for_ = wanted == kind_ ? 0 : wanted_for_ + 1;
    if (wanted_for_ < patience_) return false;
    kind_ = wanted;
    wanted_for_ = 0;
    patience_ = std::min(2 * patience_, most_patience);
    return true;
  }

 private:
  static constexpr std::size_t many_bodies = 400'000;
  static constexpr int most_patience = 64;

  Kind wants(std::size_t changes, const Answers& answers) const {
    // What is chosen is kept up to twice the threshold. The dynamic BVH alone tells changes without
    // all pairs.
    const std::size_t kept = kind_ == Kind::dynamic_bvh ? 2 : 1;
    const std::size_t few = answers.are_changes ? 8 : 32;
    if (few * changes <= kept * bodies_) return Kind::dynamic_bvh;
    if (bodies_ > many_bodies) return Kind::packed_rtree;
    const bool has_few_pairs = answers.pairs && 2 * *answers.pairs < 3 * bodies_;
    const bool suits_long_lists = bodies_ > 4'000 && bodies_ <= 50'000;
    return has_few_pairs || suits_long_lists ? Kind::verlet_list : Kind::packed_rtree;
  }

  Kind kind_ = Kind::packed_rtree;
  std::size_t bodies_ = 0;
  int wanted_for_ = 0;  // frames in a row in which another kind was wanted
  int patience_ = 1;    // frames
};

class Auto final : public BroadPhase {
 public:
  explicit Auto(Executor& executor)
      : executor_(executor), active_(make(Kind::packed_rtree, executor)) {}

  void build(std::span<const Aabb> boxes) override {
    const auto bodies = static_cast<std::size_t>(
        std::ranges::count_if(boxes, [](const Aabb& box) { return !box.is_empty(); }));
    // One that has told changes goes on, since it alone knows which.
    const Kind kind = is_told_ ? choice_.kind() : Kind::packed_rtree;
    if (kind != choice_.kind()) active_ = make(kind, executor_);
    choice_ = {kind, bodies};
    active_->build(boxes);
  }

  void update(const FrameChange& change) override {
    const bool is_replaced = choice_.update(change, {pairs_, is_told_});
    if (!is_replaced || is_told_) active_->update(change);
    if (!is_replaced) return;
    // The one before tells what has changed up to now, and the next one begins from there.
    PairSink began, ended;
    if (is_told_) {
      active_->find_changes(began, ended);
      note(began, came_);
      note(ended, went_);
    }
    active_ = make(choice_.kind(), executor_);
    active_->build(change.boxes);
    // The dynamic BVH keeps the pairs that it finds from its first update on.
    if (choice_.kind() == Kind::dynamic_bvh) active_->update({change.boxes, {}, {}, {}});
    if (is_told_) active_->find_changes(began, ended);
  }

  Status find_pairs(PairSink& sink) override {
    const Status status = active_->find_pairs(sink);
    pairs_ = sink.size();
    return status;
  }

  Status find_pairs_of(std::span<const std::uint32_t> bodies, PairSink& sink) override {
    return active_->find_pairs_of(bodies, sink);
  }

  Status find_changes(PairSink& began, PairSink& ended) override {
    const Status status = active_->find_changes(began, ended);
    is_told_ = true;
    if (!came_.empty() || !went_.empty()) {
      note(began, came_);
      note(ended, went_);
      write_difference(came_, went_, began, ended);
      came_.clear();
      went_.clear();
    }
    told_ = told_ + began.size() - ended.size();
    pairs_ = told_;
    return status;
  }

  BroadPhaseWork work() const override {
    BroadPhaseWork work = active_->work();
    work.bytes += sum_held_bytes(came_, went_);
    return work;
  }
  std::vector<StructureBox> structure() const override { return active_->structure(); }

 private:
  static void note(const PairSink& sink, std::vector<IndexPair>& pairs) {
    for (const PairBuffer& chunk : sink.chunks()) {
      pairs.insert(pairs.end(), chunk.pairs().begin(), chunk.pairs().end());
    }
  }

  Executor& executor_;
  Choice choice_;
  std::unique_ptr<BroadPhase> active_;
  std::optional<std::size_t> pairs_;  // number in the last frame that was asked about
  // Changes have been asked for; the number of the pairs then, and the changes since then that
  // the last one told when it was replaced.
  bool is_told_ = false;
  std::size_t told_ = 0;
  std::vector<IndexPair> came_, went_;
};

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<BroadPhaseEntry> broad_phase_auto() {
  return {{.info = {.name = "auto",
                    .citation = "Rice, \"The Algorithm Selection Problem\", Advances in Computers "
                                "15, 1976; of packed-rtree, verlet-list and dynamic-bvh"},
           .make = [](Executor& executor) { return std::make_unique<Auto>(executor); }}};
}

}  // namespace touchstone::entries
