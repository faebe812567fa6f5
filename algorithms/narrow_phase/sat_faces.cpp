// Separating axis test over face normals only: the gap along each face normal of both bodies.
// Paper:   Gottschalk, Lin, Manocha, "OBBTree: A Hierarchical Structure for Rapid Interference
//          Detection", SIGGRAPH 1996; section 5.2 reports on leaving out the axes of edge pairs.
// Departs: any two convex polytopes. Flat hulls, segments and points have the sides of a prism or
//          box of no thickness. Stops at the first axis that separates.
// Answers: "separated" is proven. "Overlapping" says that no face normal separates: bodies that
//          only an axis across an edge of each keeps apart are called overlapping as well. The
//          depth is the least overlap along a face normal. Where the bodies do overlap it is an
//          upper bound of the penetration depth, and exact unless an edge pair is shallower; moving
//          b by it along the normal always separates the bodies. So the lower bound of the signed
//          distance is certified, and there is no upper one. The witness points are the closest
//          points of the two supporting features as seen along the normal; where an edge pair is
//          shallower these need not lie on one line along it.
// Fails:   says not_converged where the greatest gap is below its rounding error, degenerate for a
//          solid hull that came without faces and that no axis tried separates, and capacity for
//          one of more than 16,384 vertices.
// Cost:    O(Fa Vb + Fb Va) time; no memory.
#include "algorithms/kernels/sat/polytope_query.h"
#include "algorithms/kernels/sat/separating_axis.h"
#include "algorithms/narrow_phase.h"

namespace touchstone {
namespace {

template <class Scalar>
class SatFaces final : public NarrowPhase {
 public:
  void bind(std::span<const Shape> shapes) override { shapes_.bind(shapes); }

  void solve(const PairBatch& batch, std::span<Outcome> outcomes) override {
    shapes_.solve(batch, outcomes, [&](const PolytopePair<Scalar>& pair, std::size_t i) {
      solve_pair(pair, batch.task, outcomes[i]);
    });
  }

 private:
  static void solve_pair(const PolytopePair<Scalar>& pair, Task task, Outcome& outcome) {
    int tested = 0;
    Axis<Scalar> best;
    if (!pair.far_apart()) best = pair.face_axis(tested);
    // Without faces to go by there is this one axis that needs none.
    if (!pair.far_apart() && !pair.complete() && !pair.separates(best)) {
      best = pair.centre_axis();
      ++tested;
    }
    pair.report(best, task, false, outcome);
    outcome.iterations = tested;
  }

  PolytopeShapes<Scalar> shapes_;
};

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
       .supports = are_flat_sided,
       .approximate = true,
       .depth_is_bound = true,
       .make = [](const NarrowPhaseSettings& settings) -> std::unique_ptr<NarrowPhase> {
         if (settings.scalar == Precision::float32) return std::make_unique<SatFaces<float>>();
         return std::make_unique<SatFaces<double>>();
       }}};
}
