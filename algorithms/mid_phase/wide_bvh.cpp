// Wide BVH: trees of eight boxes a node, descended together.
// Paper:   Wald, Benthin, Boulos, "Getting rid of packets", RT 2008 (wide nodes); Gottschalk, Lin,
//          Manocha, "OBBTree", SIGGRAPH 1996 (the simultaneous descent).
// Steps:   1. Build a tree of each body's boxes by the surface area heuristic (kernels/bvh/wide_bvh).
//          2. Descend both trees from their roots (wide_descent): a node's eight boxes of the second
//             body are put into the frame of the first once, and compared with each of its eight.
//          3. Compare the boxes of two leaves likewise, in double.
// Departs: boxes are compared along the six axes of both bodies' frames, without the other nine; those of
//          parts along the three of the common frame.
// Fails:   boxes of long thin parts that are turned are much larger than the parts.
// Cost:    O(n log n) build, O(n) refit, 38 bytes a part.
#include <array>
#include <span>

#include "algorithms/core/mesh/placed_box.h"
#include "algorithms/kernels/bvh/wide_descent.h"
#include "algorithms/mid_phase_of_bodies.h"

namespace touchstone {
namespace {

struct WideParts : PartBoxes {
  WideBvh tree;

  explicit WideParts(std::span<const Aabb> parts) : PartBoxes(parts), tree(build_wide_bvh(parts)) {}
  void refit(std::span<const Aabb> parts) {
    PartBoxes::refit(parts);
    touchstone::refit(tree, parts);
  }
};

class WideBvhMidPhase final : public MidPhaseOfBodies<WideParts> {
 public:
  bool find_pairs(std::uint32_t a, const Pose& pose_a, std::uint32_t b, const Pose& pose_b,
                  const TakePartPairs& take) override {
    Search search{kept(a), kept(b), {}, 0, take};
    search.frame = common_frame(pose_a, search.a.reach, pose_b, search.b.reach);
    search.slack = box_slack(search.frame, search.a.reach, search.b.reach);
    const DescentFrames frames(search.frame, search.a.reach, search.b.reach);
    return descent_.run(
        search.a.tree, search.b.tree, frames.all(),
        [](void* context, std::uint32_t leaf_a, std::uint32_t leaf_b) {
          return static_cast<Search*>(context)->visit(leaf_a, leaf_b);
        },
        &search);
  }

 private:
  struct Search {
    const WideParts &a, &b;
    CommonFrame frame;
    double slack;
    const TakePartPairs& take;

    bool visit(std::uint32_t leaf_a, std::uint32_t leaf_b) const {
      const auto parts_a = a.tree.leaf(leaf_a), parts_b = b.tree.leaf(leaf_b);
      std::array<PlacedBox, WideBvh::leaf_size> seen;
      for (std::size_t j = 0; j < parts_b.size(); ++j) {
        seen[j] = PlacedBox(b.boxes[parts_b[j]], frame.b);
      }
      std::array<IndexPair, WideBvh::leaf_size * WideBvh::leaf_size> found;
      std::size_t count = 0;
      for (const std::uint32_t i : parts_a) {
        if (a.boxes[i].is_empty()) continue;
        const PlacedBox box(a.boxes[i], frame.a);
        for (std::size_t j = 0; j < parts_b.size(); ++j) {
          if (b.boxes[parts_b[j]].is_empty()) continue;
          if (are_apart(box, seen[j], slack)) continue;
          found[count++] = {i, parts_b[j]};
        }
      }
      return count == 0 || take({found.data(), count});
    }
  };

  WideDescent descent_;
};

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<MidPhaseEntry> mid_phase_wide_bvh() {
  return {{.info = {.name = "wide-bvh",
                    .citation = "eight boxes a node: Wald, Benthin, Boulos, RT 2008; simultaneous "
                                "descent: Gottschalk, Lin, Manocha, SIGGRAPH 1996"},
           .make = [] { return std::make_unique<WideBvhMidPhase>(); }}};
}

}  // namespace touchstone::entries
