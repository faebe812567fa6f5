// Separating axis test over face normals only: the gap along each face normal of both bodies.
// Paper:   Gottschalk, Lin, Manocha, "OBBTree: A Hierarchical Structure for Rapid Interference
//          Detection", SIGGRAPH 1996; section 5.2 reports on leaving out the axes of edge pairs.
// Steps:   1. `bind` makes a polytope of each shape: faces, edges, vertices (kernels/sat/polytope).
//          2. Pairs whose bounding balls are far apart are separated (kernels/sat/polytope_query).
//          3. For each face normal of a and b, measure the gap to the other body's support vertex;
//             stop at an axis that separates (kernels/sat/separating_axis).
//          4. If a body has no faces, test the line of the centres.
//          5. Report the greatest gap: positive is separated, negative is minus the depth, with the
//             closest points of the supporting features (kernels/sat/witness_points).
// Departs: takes any two convex polytopes. Flat hulls, segments and points have the faces of a
//          prism or box without thickness. Stops at the first axis that separates.
// Answers: `separated` is proven. `overlapping` means that no face normal separates; bodies that
//          only an axis across an edge of each separates are called overlapping too. The depth is
//          the least overlap along a face normal. If the bodies overlap it is an upper bound on the
//          penetration depth, and exact unless an edge pair is shallower; moving b by it along the
//          normal always separates the bodies. So the lower bound of the signed distance is
//          certified, and there is no upper one. Witness points are the closest points of the two
//          supporting features seen along the normal; if an edge pair is shallower they need not
//          lie on one line along it.
//          If the greatest gap is below its rounding error, the answer is `touching`, with the
//          lower bound alone.
// Fails:   reports degenerate for a solid hull without faces that no tested axis separates, and
//          capacity for one of more than 16,384 vertices.
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

  void solve(Task task, const PairBatch& batch, std::span<Outcome> outcomes) override {
    shapes_.solve(task, batch, outcomes, [&](const PolytopePair<Scalar>& pair, std::size_t i) {
      solve_pair(pair, task, outcomes[i]);
    });
  }

 private:
  static void solve_pair(const PolytopePair<Scalar>& pair, Task task, Outcome& outcome) {
    int tested = 0;
    Axis<Scalar> best;
    if (!pair.far_apart()) best = pair.face_axis(tested);
    // A hull without faces is tested along this one axis, which needs none.
    if (!pair.far_apart() && !pair.complete() && !pair.separates(best)) {
      best = pair.centre_axis();
      ++tested;
    }
    pair.report(best, task, false, outcome);
    outcome.iterations = tested;
    outcome.support_calls = -1;
  }

  PolytopeShapes<Scalar> shapes_;
};

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<NarrowPhaseEntry> narrow_phase_sat_faces() {
  return {
      {.info = {.name = "sat-faces",
                .citation = "Gottschalk, Lin, Manocha, OBBTree, SIGGRAPH 1996: separating axes, "
                            "face normals only"},
       .tasks = {Task::intersect, Task::penetration},
       .scalars = {Precision::float32, Precision::float64},
       .supports = are_polytopes,
       .traits = {.approximate = true, .depth_is_bound = true},
       .make = [](const NarrowPhaseSettings& settings) -> std::unique_ptr<NarrowPhase> {
         if (settings.scalar == Precision::float32) return std::make_unique<SatFaces<float>>();
         return std::make_unique<SatFaces<double>>();
       }}};
}

}  // namespace touchstone::entries
