// Auto: the Verlet list, which is the packed R-tree where no list pays, the dynamic BVH or
// sweep and prune, whichever suits the frames that come.
// Paper:   Rice, "The Algorithm Selection Problem", Advances in Computers 15, 1976; Karlin, Manasse,
//          Rudolph, Sleator, "Competitive Snoopy Caching", Algorithmica 3, 1988.
// Steps:   1. Start with the Verlet list, which needs no earlier frame and builds the packed R-tree.
//          2. In each update count the bodies that moved, came or went, and take the pairs of the
//             frame before (choice.cpp).
//          3. Few changes want the dynamic BVH, the fewer the more pairs there are; others the Verlet
//             list, which chooses itself between a list and the packed R-tree by counts
//             (verlet_list/rebuild_interval.cpp).
//          4. When another one has been wanted for some frames in a row, build it with this frame's
//             boxes, and drop the one before. The first frame after a build suffices.
//          5. While changes are few, look now and then how far some of the bodies move, and estimate
//             how many end points they pass (endpoint_passes.cpp). This and the counts say what the
//             dynamic BVH and sweep and prune would cost (frame_costs.cpp). When the one
//             in charge has lost a part of what the other's build costs, that one takes over
//             (looks.cpp). Where only pairs of some bodies are asked for, these stand for all.
// Departs: it decides by counts and not by times, so that the order of the pairs does not depend on
//          the machine, its load or the executor's width. Each change of mind doubles the number of
//          frames that the next one takes, or what must be lost for it, until the next build.
//          Thresholds and costs are measured.
// Fails:   bodies that rest for some frames and then move for some: it follows late, and builds
//          anew each time. Bodies of which each moves for a single frame: their passes are not seen,
//          and the dynamic BVH stays.
// Cost:    that of the one chosen, and a build at each change of mind; looks take less than a
//          hundredth of the time.
#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include "algorithms/broad_phase.h"
#include "algorithms/broad_phase/auto/choice.h"
#include "algorithms/broad_phase/auto/noted_changes.h"
#include "algorithms/core/memory_usage.h"

namespace touchstone::entries {

std::vector<BroadPhaseEntry> broad_phase_verlet_list();
std::vector<BroadPhaseEntry> broad_phase_dynamic_bvh();
std::vector<BroadPhaseEntry> broad_phase_sweep_and_prune();

}  // namespace touchstone::entries

namespace touchstone {
namespace {

std::unique_ptr<BroadPhase> make(Candidate candidate, Executor& executor) {
  switch (candidate) {
    case Candidate::dynamic_bvh: return entries::broad_phase_dynamic_bvh()[0].make(executor);
    case Candidate::sweep_and_prune:
      return entries::broad_phase_sweep_and_prune()[0].make(executor);
    default: return entries::broad_phase_verlet_list()[0].make(executor);
  }
}

class Auto final : public BroadPhase {
 public:
  explicit Auto(Executor& executor)
      : executor_(executor), active_(make(Candidate::verlet_list, executor)) {}

  void build(std::span<const Aabb> boxes) override {
    const auto bodies = static_cast<std::size_t>(
        std::ranges::count_if(boxes, [](const Aabb& box) { return !box.is_empty(); }));
    // One that has told changes goes on, since it alone knows which.
    const Candidate candidate = answers_.are_changes ? choice_.candidate() : Candidate::verlet_list;
    if (candidate != choice_.candidate()) active_ = make(candidate, executor_);
    choice_.start(candidate, bodies);
    active_->build(boxes);
  }

  void update(const FrameChange& change) override {
    if (choice_.update(change, answers_)) return replace(change);
    active_->update(change);
  }

  Status find_pairs(PairSink& sink) override {
    const Status status = active_->find_pairs(sink);
    ++answers_.tally.listings;
    answers_.is_known = true;
    answers_.pairs = sink.size();
    answers_.changes = 0;
    return status;
  }

  Status find_pairs_of(std::span<const std::uint32_t> bodies, PairSink& sink) override {
    const Status status = active_->find_pairs_of(bodies, sink);
    ++answers_.tally.selections;
    if (!bodies.empty()) {
      answers_.asked_bodies = bodies.size();
      answers_.found_pairs = sink.size();
    }
    return status;
  }

  Status find_changes(PairSink& began, PairSink& ended) override {
    const Status status = active_->find_changes(began, ended);
    if (!noted_.empty()) noted_.join(began, ended);
    const std::size_t came = began.size(), went = ended.size();
    told_ += came - went;
    answers_.are_changes = answers_.is_known = true;
    answers_.pairs = told_;
    answers_.changes = came + went;
    return status;
  }

  BroadPhaseWork work() const override {
    BroadPhaseWork work = active_->work();
    work.bytes += sum_held_bytes(choice_, noted_);
    return work;
  }
  std::vector<StructureBox> structure() const override { return active_->structure(); }

 private:
  // Makes the one that is chosen now take over with this frame. Where little moves, all of update
  // takes a few nanoseconds: this is kept out of it.
  [[gnu::noinline]] void replace(const FrameChange& change) {
    // The one before tells what has changed up to now, and the next one begins from there.
    if (answers_.are_changes) {
      active_->update(change);
      noted_.note(*active_);
    }
    answers_.tally = {};
    active_ = make(choice_.candidate(), executor_);
    active_->build(change.boxes);
    // The dynamic BVH keeps the pairs that it finds from its first update on, when it also sees how
    // far bodies move. It need not wait where nothing does.
    const bool waits = choice_.candidate() != Candidate::dynamic_bvh || !change.moved.empty();
    if (!waits) active_->update({change.boxes, {}, {}, {}});
    if (answers_.are_changes) {
      PairSink all, none;
      active_->find_changes(all, none);
    }
  }

  Executor& executor_;
  Choice choice_;
  std::unique_ptr<BroadPhase> active_;
  Answers answers_;
  std::size_t told_ = 0;  // number of the pairs when changes were last asked for
  NotedChanges noted_;
};

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<BroadPhaseEntry> broad_phase_auto() {
  return {{.info = {.name = "auto",
                    .citation = "Rice, \"The Algorithm Selection Problem\", Advances in Computers "
                                "15, 1976; of verlet-list, which is packed-rtree where no list "
                                "pays, dynamic-bvh and sweep-and-prune"},
           .make = [](Executor& executor) { return std::make_unique<Auto>(executor); }}};
}

}  // namespace touchstone::entries
