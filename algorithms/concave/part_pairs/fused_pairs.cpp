// Pairs of triangles by a descent whose leaves are tested eight triangles at once.
#include <bit>
#include <limits>
#include <utility>

#include "algorithms/concave/part_pairs/mesh_pairs.h"
#include "algorithms/core/mesh/common_frame.h"
#include "algorithms/kernels/bvh/wide_descent.h"
#include "algorithms/kernels/triangles/triangle_signs.h"

namespace touchstone {
namespace {

// The bits of all triangles' pairs, eight for each of the first block's.
std::uint64_t joined(const std::array<std::uint8_t, TriangleBlock::size>& bits) {
  std::uint64_t all = 0;
  for (std::size_t i = 0; i < bits.size(); ++i) all |= std::uint64_t{bits[i]} << 8 * i;
  return all;
}

class FusedPairs final : public MeshPairs {
 public:
  explicit FusedPairs(std::shared_ptr<const MeshTrees> trees) : trees_(std::move(trees)) {}

  void bind(std::span<const BoundBody> bodies) override { bodies_ = bodies; }

  void find(const PlacedConcave& a, const PlacedConcave& b, const TakePartPairs& take) override {
    Search search{(*trees_)[a.body],
                  (*trees_)[b.body],
                  bodies_[a.body],
                  bodies_[b.body],
                  a.pose,
                  b.pose,
                  common_frame(a.pose, bodies_[a.body].reach, b.pose, bodies_[b.body].reach),
                  take};
    const DescentFrames frames(search.frame, search.body_a.reach, search.body_b.reach);
    descent_.run(
        search.a.tree, search.b.tree, frames.all(),
        [](void* context, std::uint32_t leaf_a, std::uint32_t leaf_b) {
          return static_cast<Search*>(context)->visit(leaf_a, leaf_b);
        },
        &search);
  }

 private:
  struct Search {
    const MeshTree &a, &b;
    const BoundBody &body_a, &body_b;
    const Pose &pose_a, &pose_b;
    CommonFrame frame;
    const TakePartPairs& take;
    // The leaf of b that was last seen, its block in the frame, and the block's extent, if it was needed.
    std::uint32_t seen_b = std::numeric_limits<std::uint32_t>::max();
    TriangleBlock moved_b = {};
    BlockExtent extent_b = {};
    bool is_measured = false;  // the extent is that of the block

    bool visit(std::uint32_t leaf_a, std::uint32_t leaf_b) {
      const auto parts_a = a.tree.leaf(leaf_a), parts_b = b.tree.leaf(leaf_b);
      if (leaf_b != seen_b) see(leaf_b);
      unsigned lanes_a = (1u << parts_a.size()) - 1, lanes_b = (1u << parts_b.size()) - 1;
      BlockSigns signs;
      if (frame.is_of_a) {
        // A coordinate of b is rounded to an eighth of `error`. Two projections are off by twice that of
        // their coordinates, and by 6 u of these by rounding.
        const double slack = 6 * frame.error + 0x1p-48 * body_a.reach;
        lanes_b &= reaching(moved_b, a.extents[leaf_a], slack);
        if (lanes_b == 0) return true;
        measure_seen();
        const bool is_any = a.blocks.with(leaf_a, [&](const auto& block) {
          lanes_a &= reaching(block, extent_b, slack);
          return lanes_a != 0 && compare(block, lanes_a, moved_b, lanes_b, frame.error, signs);
        });
        if (!is_any) return true;
      } else {
        TriangleBlock moved_a;
        a.blocks.move(leaf_a, frame.a, moved_a);
        if (!compare(moved_a, lanes_a, moved_b, lanes_b, frame.error, signs)) return true;
      }
      std::array<IndexPair, TriangleBlock::size * TriangleBlock::size> found;
      std::size_t count = 0;
      const std::uint64_t sure = joined(signs.yes);
      for (std::uint64_t bits = sure | joined(signs.open); bits != 0; bits &= bits - 1) {
        const auto at = static_cast<std::size_t>(std::countr_zero(bits));
        const IndexPair pair = {parts_a[at / 8], parts_b[at % 8]};
        if ((sure >> at & 1) == 0 &&
            !share_a_point(body_a.corners(pair.a), pose_a, body_b.corners(pair.b), pose_b)) {
          continue;
        }
        found[count++] = pair;
      }
      return count == 0 || take({found.data(), count});
    }

    void see(std::uint32_t leaf_b) {
      seen_b = leaf_b;
      is_measured = false;
      b.blocks.move(leaf_b, frame.b, moved_b);
    }

    void measure_seen() {
      if (is_measured) return;
      is_measured = true;
      // Any way serves whose coordinates' magnitudes sum up to 2 at most: what is rounded moves it a
      // little.
      const Vec3d way = frame.b.rotation * b.extents[seen_b].way;
      const double sum = way.cwiseAbs().sum();
      extent_b = extent_along(moved_b, sum <= 1.9 ? way : Vec3d(way / sum));
    }
  };

  std::span<const BoundBody> bodies_;
  std::shared_ptr<const MeshTrees> trees_;
  WideDescent descent_;
};

}  // namespace

std::unique_ptr<MeshPairs> fused_pairs(std::shared_ptr<const MeshTrees> trees) {
  return std::make_unique<FusedPairs>(std::move(trees));
}

}  // namespace touchstone
