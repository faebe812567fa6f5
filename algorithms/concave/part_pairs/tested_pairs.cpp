// Pairs of triangles by a mid-phase and a test of one pair.
#include "algorithms/concave/part_pairs/mesh_pairs.h"
#include "algorithms/core/mesh/common_frame.h"
#include "algorithms/kernels/triangles/triangle_signs.h"

namespace touchstone {
namespace {

class TestedPairs final : public MeshPairs {
 public:
  TestedPairs(std::shared_ptr<MidPhase> mid_phase, RoughTest test)
      : mid_phase_(std::move(mid_phase)), test_(test) {}

  // The mid-phase has the bodies already.
  void bind(std::span<const BoundBody> bodies) override { bodies_ = bodies; }

  void find(const PlacedConcave& a, const PlacedConcave& b, const TakePartPairs& take) override {
    const BoundBody &first = bodies_[a.body], &second = bodies_[b.body];
    const CommonFrame frame = common_frame(a.pose, first.reach, b.pose, second.reach);
    mid_phase_->find_pairs(a.body, a.pose, b.body, b.pose, [&](std::span<const IndexPair> pairs) {
      found_.clear();
      for (const IndexPair& pair : pairs) {
        const TriangleCorners in_a = first.corners(pair.a), in_b = second.corners(pair.b);
        int yes =
            test_(frame.is_of_a ? in_a : moved(in_a, frame.a), moved(in_b, frame.b), frame.error);
        if (yes < 0) yes = share_a_point(in_a, a.pose, in_b, b.pose) ? 1 : 0;
        if (yes > 0) found_.push_back(pair);
      }
      return found_.empty() || take(found_);
    });
  }

 private:
  static TriangleCorners moved(const TriangleCorners& corners, const Pose& pose) {
    return {pose(corners[0]), pose(corners[1]), pose(corners[2])};
  }

  std::shared_ptr<MidPhase> mid_phase_;
  RoughTest test_;
  std::span<const BoundBody> bodies_;
  std::vector<IndexPair> found_;
};

TriangleBlock block_of(const TriangleCorners& corners) {
  TriangleBlock block;
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      block.at[3 * k + axis].fill(corners[k][static_cast<int>(axis)]);
    }
  }
  return block;
}

}  // namespace

std::unique_ptr<MeshPairs> tested_pairs(std::shared_ptr<MidPhase> mid_phase, RoughTest test) {
  return std::make_unique<TestedPairs>(std::move(mid_phase), test);
}

int test_by_signs(const TriangleCorners& a, const TriangleCorners& b, double error) {
  BlockSigns signs;
  compare(block_of(a), 1, block_of(b), 1, error, signs);
  if (signs.yes[0] != 0) return 1;
  return signs.open[0] != 0 ? -1 : 0;
}

}  // namespace touchstone
