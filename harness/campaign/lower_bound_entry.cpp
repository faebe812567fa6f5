// A broad phase that only writes known pairs.
#include "harness/campaign/lower_bound_entry.h"

#include <algorithm>
#include <memory>

#include "algorithms/limit.h"
#include "harness/stats/samples.h"

namespace touchstone::campaign {
namespace {

// Writes the pairs that the input holds.
class LowerBound final : public BroadPhase {
 public:
  LowerBound(Executor& executor, const measure::BlockInput& input)
      : bound_(make_broad_phase_limit(executor)), input_(input) {}

  void build(std::span<const Aabb> boxes) override {
    boxes_ = boxes;
    bound_->sort_and_gather(boxes);
  }
  void update(const FrameChange& change) override { build(change.boxes); }
  Status find_pairs(PairSink& sink) override {
    // The frame to which these boxes belong.
    const auto frame = std::ranges::find_if(input_.frames, [&](const measure::BlockFrame& own) {
      return own.boxes.data() == boxes_.data();
    });
    bound_->write(frame->truth, sink);
    return Status::ok;
  }

 private:
  std::unique_ptr<BroadPhaseLimit> bound_;
  const measure::BlockInput& input_;
  std::span<const Aabb> boxes_;
};

}  // namespace

BroadPhaseEntry lower_bound_entry(const measure::BlockInput& input) {
  return {.info = {.name = stats::limit_label,
                   .citation = "a radix sort, a gather, and the writing of the pairs",
                   .origin = Origin::oracle},
          .make = [&input](Executor& executor) {
            return std::make_unique<LowerBound>(executor, input);
          }};
}

}  // namespace touchstone::campaign
