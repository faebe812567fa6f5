// Minkowski portal refinement (MPR, XenoCollide): casts a ray from inside the Minkowski difference
// C = A - B to the origin and pushes the triangle of support points that it passes through outward,
// until the origin is inside or a plane separates it.
// Paper:   Snethen, "XenoCollide: Complex Collision Made Simple", Game Programming Gems 7, 2008.
// Steps:   1. `bind` makes a support shape of each shape; `solve` prefetches the shapes of later
//             pairs.
//          2. A half-space takes one support point (kernels/minkowski/halfspace).
//          3. Otherwise find a portal for the ray from the centres' difference to the origin
//             (kernels/mpr/portal_search).
//          4. Push the portal outward until a plane separates or the origin is enclosed.
//          5. For a depth, push the portal to the surface of C.
//          6. Cast a ray from the origin along the portal's normal, and repeat until the depth no
//             longer falls.
//          7. Write the depth along the last normal and the witness points where the ray passes the
//             portal.
// Departs: for a depth the ray is cast again from the origin along the portal's normal until the
//          normal stays, which lowers the bound each time.
// Answers: the depth is that along the normal of the last portal. Moving b by it separates, so it
//          is an upper bound on the penetration depth and in general not the least. `lower` is
//          certified; `upper` is 0. For a half-space the depth is exact. `touching`, with bounds on
//          the signed distance, within gjk's resolution (kernels/minkowski/resolution).
// Fails:   reports not_converged at the cap, and if rounding hides on which side of C the origin
//          is and the bounds are further apart than that. Flat and very thin differences end there sooner (plates of 1:1e8 at gaps of 1e-6).
// Cost:    one support call per iteration; few iterations for polytopes, a hundred or more for the
//          depth of curved shapes.
#include <algorithm>

#include "algorithms/kernels/batch/for_each_pair.h"
#include "algorithms/kernels/mpr/portal_search.h"
#include "algorithms/narrow_phase.h"

namespace touchstone {
namespace {

// Solves one query on two bounded bodies.
template <class Scalar>
void solve_pair(SupportPair<Scalar>& pair, int max_iterations, Scalar tolerance, Task task,
                Outcome& outcome) {
  using Search = PortalSearch<Scalar>;
  Search search(pair, max_iterations, tolerance);
  const auto exit = search.decide(task, outcome);
  if (outcome.answer == Answer::overlapping && task == Task::penetration) {
    const typename Search::Depth found =
        exit == Search::Exit::straight
            ? typename Search::Depth{search.depth(), search.normal(), true}
            : search.settle_from_portal();
    outcome.distance = -pair.unit() * static_cast<double>(found.depth);
    outcome.lower = -pair.unit() * static_cast<double>(found.depth + Search::rounding);
    outcome.upper = 0;
    outcome.normal = found.normal.template cast<double>().normalized();
    if (found.settled) {
      const DifferencePoint<Scalar> point = search.passage();
      outcome.witness_a = pair.to_world(point.a);
      outcome.witness_b = pair.to_world(point.b);
    } else {
      outcome.witness_a = outcome.witness_b = Vec3d::Constant(Outcome::none);
      outcome.status = Status::not_converged;
    }
  }
  outcome.iterations = search.iterations();
  outcome.support_calls = pair.support_calls();
}

template <class Scalar>
class Mpr final : public NarrowPhase {
 public:
  explicit Mpr(const NarrowPhaseSettings& settings)
      : max_iterations_(settings.max_iterations.value_or(256)),
        tolerance_(std::max(static_cast<Scalar>(settings.tolerance.value_or(default_tolerance)),
                            4 * SupportPair<Scalar>::rounding)) {}

  void bind(std::span<const Shape> shapes) override {
    shapes_ = make_support_shapes<Scalar>(shapes);
    ahead_.bind(shapes_);
  }

  void solve(Task task, const PairBatch& batch, std::span<Outcome> outcomes) override {
    for_each_bounded_pair(task, batch, shapes_, ahead_, true, outcomes,
                          [&](std::size_t i, const auto&... bodies) {
                            SupportPair<Scalar> pair(bodies...);
                            solve_pair(pair, max_iterations_, tolerance_, task, outcomes[i]);
                          });
  }

 private:
  // A portal on a curved surface that is as narrow as the root of this still has a normal.
  static constexpr double default_tolerance = 1e-10;

  int max_iterations_;
  Scalar tolerance_;  // in the pair's unit
  std::vector<SupportShape<Scalar>> shapes_;
  ShapePrefetch<Scalar> ahead_;
};

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<NarrowPhaseEntry> narrow_phase_mpr() {
  return {{.info = {.name = "mpr",
                    .citation = "Snethen, XenoCollide: Complex Collision Made Simple, Game "
                                "Programming Gems 7, 2008"},
           .tasks = {Task::intersect, Task::penetration},
           .scalars = {Precision::float32, Precision::float64},
           .traits = {.depth_is_bound = true},
           .tolerance = "how far the surface is beyond the portal, along its normal; 1e-10 (float "
                        "8e-6): no error of the depth, which is an upper bound",
           .make = [](const NarrowPhaseSettings& settings) -> std::unique_ptr<NarrowPhase> {
             if (settings.scalar == Precision::float32)
               return std::make_unique<Mpr<float>>(settings);
             return std::make_unique<Mpr<double>>(settings);
           }}};
}

}  // namespace touchstone::entries
