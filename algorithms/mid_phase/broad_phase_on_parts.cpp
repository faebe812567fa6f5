// Broad phase on the parts: the boxes of both bodies' parts go through a broad phase.
// Paper:   those of the broad phases; how scene graphs without a mid-phase do it.
// Steps:   1. Put the boxes of both bodies into one frame, along its axes, and drop those that lie beside
//             the other body's.
//          2. Build a broad phase with the rest, each grown by a bound on the rounding.
//          3. Keep the pairs that have a part of either body. Boundless parts meet all others.
// Departs: the broad phase is built anew for each question, as the poses are others.
// Fails:   parts of one body that overlap each other, as neighbours in a mesh do, are found and dropped.
// Cost:    that of a build with the parts near the other body, and of their pairs; O(n + m) besides.
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "algorithms/broad_phase.h"
#include "algorithms/core/bounds.h"
#include "algorithms/core/mesh/placed_box.h"
#include "algorithms/mid_phase_of_bodies.h"

namespace touchstone::entries {

std::vector<BroadPhaseEntry> broad_phase_packed_rtree();
std::vector<BroadPhaseEntry> broad_phase_sweep_one_axis();
std::vector<BroadPhaseEntry> broad_phase_uniform_grid();

}  // namespace touchstone::entries

namespace touchstone {
namespace {

// The parts of one body in the frame. Those that are finite have a box each.
struct PlacedParts {
  std::vector<std::uint32_t> finite, boundless;
  std::vector<Aabb> boxes;

  // Boxes are grown by `slack` and rounded outward.
  void place(const PartBoxes& body, const Pose& pose, double slack) {
    finite.clear();
    boundless.clear();
    boxes.clear();
    for (std::uint32_t i = 0; i < body.boxes.size(); ++i) {
      if (body.boxes[i].is_empty()) continue;
      const PlacedBox placed(body.boxes[i], pose);
      const Vec3d low = (placed.centre - placed.half).array() - slack;
      const Vec3d high = (placed.centre + placed.half).array() + slack;
      constexpr double most = std::numeric_limits<float>::max();
      // NaN fails as well.
      if (!(low.minCoeff() > -most && high.maxCoeff() < most)) {
        boundless.push_back(i);
        continue;
      }
      Aabb& box = boxes.emplace_back();
      for (int k = 0; k < 3; ++k) {
        box.min[k] = round_down(low[k]);
        box.max[k] = round_up(high[k]);
      }
      finite.push_back(i);
    }
  }

  Aabb whole() const {
    Aabb all = Aabb::empty();
    for (const Aabb& box : boxes) {
      for (int k = 0; k < 3; ++k) {
        all.min[k] = std::min(all.min[k], box.min[k]);
        all.max[k] = std::max(all.max[k], box.max[k]);
      }
    }
    return all;
  }

  void keep_those_in(const Aabb& box) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < finite.size(); ++i) {
      if (!overlap(boxes[i], box)) continue;
      finite[kept] = finite[i];
      boxes[kept++] = boxes[i];
    }
    finite.resize(kept);
    boxes.resize(kept);
  }
};

// Hands pairs over in portions.
class Portions {
 public:
  Portions(std::vector<IndexPair>& found, const TakePartPairs& take) : found_(found), take_(take) {
    found_.clear();
  }
  bool push(std::uint32_t a, std::uint32_t b) {
    found_.push_back({a, b});
    return found_.size() < most || flush();
  }
  bool flush() {
    const bool goes_on = found_.empty() || take_(found_);
    found_.clear();
    return goes_on;
  }

 private:
  static constexpr std::size_t most = 64;
  std::vector<IndexPair>& found_;
  const TakePartPairs& take_;
};

class BroadPhaseOnParts final : public MidPhaseOfBodies<PartBoxes> {
 public:
  explicit BroadPhaseOnParts(const BroadPhaseEntry& entry) : broad_(entry.make(executor_)) {}

  bool find_pairs(std::uint32_t a, const Pose& pose_a, std::uint32_t b, const Pose& pose_b,
                  const TakePartPairs& take) override {
    const PartBoxes &body_a = kept(a), &body_b = kept(b);
    const CommonFrame frame = common_frame(pose_a, body_a.reach, pose_b, body_b.reach);
    const double slack = box_slack(frame, body_a.reach, body_b.reach);
    a_.place(body_a, frame.a, slack);
    b_.place(body_b, frame.b, slack);
    Portions portions(found_, take);
    return push_boundless(portions) && push_finite(portions) && portions.flush();
  }

 private:
  bool push_boundless(Portions& portions) const {
    for (const std::uint32_t i : a_.boundless) {
      for (const auto* parts : {&b_.boundless, &b_.finite}) {
        for (const std::uint32_t j : *parts) {
          if (!portions.push(i, j)) return false;
        }
      }
    }
    for (const std::uint32_t i : a_.finite) {
      for (const std::uint32_t j : b_.boundless) {
        if (!portions.push(i, j)) return false;
      }
    }
    return true;
  }

  bool push_finite(Portions& portions) {
    const Aabb whole_a = a_.whole(), whole_b = b_.whole();
    a_.keep_those_in(whole_b);
    b_.keep_those_in(whole_a);
    if (a_.finite.empty() || b_.finite.empty()) return true;
    boxes_ = a_.boxes;
    boxes_.insert(boxes_.end(), b_.boxes.begin(), b_.boxes.end());
    broad_->build(boxes_);
    if (broad_->find_pairs(pairs_) != Status::ok) return push_all(portions);
    const auto first_of_b = static_cast<std::uint32_t>(a_.finite.size());
    for (const PairBuffer& chunk : pairs_.chunks()) {
      for (const IndexPair pair : chunk.pairs()) {
        if (pair.a >= first_of_b || pair.b < first_of_b) continue;
        if (!portions.push(a_.finite[pair.a], b_.finite[pair.b - first_of_b])) return false;
      }
    }
    return true;
  }

  // Of a broad phase that gave up no pair is left out.
  bool push_all(Portions& portions) const {
    for (const std::uint32_t i : a_.finite) {
      for (const std::uint32_t j : b_.finite) {
        if (!portions.push(i, j)) return false;
      }
    }
    return true;
  }

  Executor executor_{1};
  std::unique_ptr<BroadPhase> broad_;
  PlacedParts a_, b_;
  std::vector<Aabb> boxes_;  // those of a_, then those of b_
  PairSink pairs_;
  std::vector<IndexPair> found_;
};

MidPhaseEntry entry_of(const std::vector<BroadPhaseEntry>& entries) {
  const BroadPhaseEntry& broad = entries.at(0);
  return {.info = {.name = broad.info.name + "-on-parts", .citation = broad.info.citation},
          .make = [broad] { return std::make_unique<BroadPhaseOnParts>(broad); }};
}

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<MidPhaseEntry> mid_phase_broad_phase_on_parts() {
  return {entry_of(broad_phase_sweep_one_axis()), entry_of(broad_phase_uniform_grid()),
          entry_of(broad_phase_packed_rtree())};
}

}  // namespace touchstone::entries
