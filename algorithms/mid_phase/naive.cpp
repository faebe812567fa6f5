// Naive: every box of one body against every box of the other.
// Paper:   none; it is what the others are compared with.
// Steps:   1. Put the boxes of the second body into the frame of the first, and grow each to a box
//             along that frame's axes.
//          2. Compare each with each, along these three axes.
// Departs: -
// Fails:   is quadratic.
// Cost:    O(n m) time, O(n + m) memory.
#include <vector>

#include "algorithms/core/mesh/placed_box.h"
#include "algorithms/mid_phase_of_bodies.h"

namespace touchstone {
namespace {

class NaiveMidPhase final : public MidPhaseOfBodies<PartBoxes> {
 public:
  bool find_pairs(std::uint32_t a, const Pose& pose_a, std::uint32_t b, const Pose& pose_b,
                  const TakePartPairs& take) override {
    const PartBoxes &parts_a = kept(a), &parts_b = kept(b);
    const CommonFrame frame = common_frame(pose_a, parts_a.reach, pose_b, parts_b.reach);
    const double slack = box_slack(frame, parts_a.reach, parts_b.reach);
    seen_.clear();
    for (const Aabb& box : parts_b.boxes) seen_.emplace_back(box, frame.b);
    for (std::uint32_t i = 0; i < parts_a.boxes.size(); ++i) {
      if (parts_a.boxes[i].is_empty()) continue;
      const PlacedBox box(parts_a.boxes[i], frame.a);
      found_.clear();
      for (std::uint32_t j = 0; j < seen_.size(); ++j) {
        if (parts_b.boxes[j].is_empty()) continue;
        if (are_apart(box, seen_[j], slack)) continue;
        found_.push_back({i, j});
      }
      if (!found_.empty() && !take(found_)) return false;
    }
    return true;
  }

 private:
  std::vector<PlacedBox> seen_;
  std::vector<IndexPair> found_;
};

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<MidPhaseEntry> mid_phase_naive() {
  return {{.info = {.name = "naive", .citation = "every box against every box"},
           .make = [] { return std::make_unique<NaiveMidPhase>(); }}};
}

}  // namespace touchstone::entries
