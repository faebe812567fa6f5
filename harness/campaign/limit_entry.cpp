#include "harness/campaign/limit_entry.h"

#include <algorithm>
#include <memory>

#include "algorithms/limit.h"
#include "harness/stats/samples.h"

namespace touchstone {
namespace {

class Told final : public BroadPhase {
 public:
  Told(Executor& executor, const BlockInput& input)
      : limit_(make_broad_phase_limit(executor)), input_(input) {}

  void build(std::span<const Aabb> boxes) override {
    boxes_ = boxes;
    limit_->sort_and_gather(boxes);
  }
  void update(const FrameChange& change) override { build(change.boxes); }
  Status find_pairs(PairSink& sink) override {
    // The frame that these boxes are of.
    const auto frame = std::ranges::find_if(
        input_.frames, [&](const BlockFrame& own) { return own.boxes.data() == boxes_.data(); });
    limit_->write(frame->truth, sink);
    return Status::ok;
  }

 private:
  std::unique_ptr<BroadPhaseLimit> limit_;
  const BlockInput& input_;
  std::span<const Aabb> boxes_;
};

}  // namespace

BroadPhaseEntry limit_entry(const BlockInput& input) {
  return {.info = {.name = stats::limit_label,
                   .citation = "a radix sort, a gather, and the writing of the pairs",
                   .origin = Origin::oracle},
          .make = [&input](Executor& executor) { return std::make_unique<Told>(executor, input); }};
}

}  // namespace touchstone
