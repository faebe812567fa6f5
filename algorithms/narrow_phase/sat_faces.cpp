// Separating axis test over face normals only: the gap along each face normal of both bodies.
// Paper:   Gottschalk, Lin, Manocha, "OBBTree: A Hierarchical Structure for Rapid Interference
//          Detection", SIGGRAPH 1996; section 5.2 reports on leaving out the axes of edge pairs.
// Departs: any two convex polytopes. Flat hulls, segments and points have the sides of a prism or
//          box of no thickness. Stops at the first axis that separates.
// Answers: "separated" is proven. "Overlapping" says that no face normal separates: bodies that
// only
//          an axis across an edge of each keeps apart are called overlapping as well. The depth is
//          the least overlap along a face normal. Where the bodies do overlap it is an upper bound
//          of the penetration depth, and exact unless an edge pair is shallower; moving b by it
//          along the normal always separates the bodies. So the lower bound of the signed distance
//          is certified, and there is no upper one. The witness points are the closest points of
//          the two supporting features as seen along the normal; where an edge pair is shallower
//          these need not lie on one line along it.
// Fails:   says not_converged where the greatest gap is below its rounding error, and degenerate
// for
//          a solid hull that came without faces and that no axis tried separates.
// Cost:    O(Fa Vb + Fb Va) time; no memory.
#include "algorithms/kernels/halfspace.h"
#include "algorithms/kernels/separating_axis.h"
#include "algorithms/kernels/support.h"
#include "algorithms/narrow_phase.h"

namespace touchstone {
namespace {

template <class Scalar>
class SatFaces final : public NarrowPhase {
 public:
  void bind(std::span<const Shape> shapes) override {
    polytopes_ = make_polytopes<Scalar>(shapes);
    support_shapes_ = make_support_shapes<Scalar>(shapes);
  }

  void solve(const PairBatch& batch, std::span<Outcome> outcomes) override {
    for (std::size_t i = 0; i < batch.size(); ++i) {
      const std::uint32_t first = batch.first[i], second = batch.second[i];
      const std::uint32_t a = batch.shape_of[first], b = batch.shape_of[second];
      const Pose &pose_a = batch.poses[first], &pose_b = batch.poses[second];
      if (batch.kind_b == ShapeKind::halfspace) {
        solve_halfspace(support_shapes_[a], pose_a, support_shapes_[b], pose_b, batch.task,
                        outcomes[i]);
      } else {
        const PolytopePair<Scalar> pair(polytopes_[a], pose_a, polytopes_[b], pose_b);
        solve_pair(pair, batch.task, outcomes[i]);
      }
    }
  }

 private:
  static void solve_pair(const PolytopePair<Scalar>& pair, Task task, Outcome& outcome) {
    int tested = 0;
    Axis<Scalar> best;
    if (!pair.far_apart()) best = pair.face_axis(tested);
    pair.report(best, task, false, outcome);
    outcome.iterations = tested;
  }

  std::vector<Polytope<Scalar>> polytopes_;
  std::vector<SupportShape<Scalar>> support_shapes_;
};

bool takes(ShapeKind a, ShapeKind b, Task) {
  const auto flat_sided = [](ShapeKind kind) {
    return kind == ShapeKind::box || kind == ShapeKind::hull;
  };
  return flat_sided(a) && (flat_sided(b) || b == ShapeKind::halfspace);
}

}  // namespace
}  // namespace touchstone

TOUCHSTONE_NARROW_PHASE {
  using namespace touchstone;
  return {
      {.info = {.name = "sat-faces",
                .citation = "Gottschalk, Lin, Manocha, OBBTree, SIGGRAPH 1996: separating axes, "
                            "face normals only"},
       .tasks = {Task::intersect, Task::penetration},
       .scalars = {Precision::float32, Precision::float64},
       .supports = takes,
       .approximate = true,
       .make = [](const NarrowPhaseSettings& settings) -> std::unique_ptr<NarrowPhase> {
         if (settings.scalar == Precision::float32) return std::make_unique<SatFaces<float>>();
         return std::make_unique<SatFaces<double>>();
       }}};
}
