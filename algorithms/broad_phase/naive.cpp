// Naive: test every box against every other.
// Paper:   none; the definition of the problem, and the reference that the others are checked
// against. Fails:   quadratic, whatever the scene. Cost:    O(n^2) time, O(1) memory beside the
// output.
#include "algorithms/broad_phase.h"

namespace touchstone {
namespace {

class Naive final : public BroadPhase {
 public:
  void build(std::span<const Aabb> boxes) override { boxes_ = boxes; }
  void update(const FrameChange& change) override { boxes_ = change.boxes; }
  Status find_pairs(PairSink& sink) override {
    sink.start(1);
    PairBuffer& out = sink.chunk(0);
    for (std::uint32_t i = 0; i < boxes_.size(); ++i) {
      for (std::uint32_t j = i + 1; j < boxes_.size(); ++j) {
        if (overlap(boxes_[i], boxes_[j])) out.push(i, j);
      }
    }
    return Status::ok;
  }

 private:
  std::span<const Aabb> boxes_;
};

}  // namespace
}  // namespace touchstone

TOUCHSTONE_BROAD_PHASE {
  return {{.info = {.name = "naive", .citation = "definition: every pair of boxes is tested"},
           .make = [](touchstone::Executor&) { return std::make_unique<touchstone::Naive>(); }}};
}
