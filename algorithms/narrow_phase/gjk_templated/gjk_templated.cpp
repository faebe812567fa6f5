// GJK compiled once for each pair of shape kinds: the iteration of gjk, with support calls that
// need no switch at run time.
// Paper:   Gilbert, Johnson, Keerthi, IEEE J. Robotics and Automation 4(2), 1988.
// Steps:   1. `bind` makes a support shape of each shape; `solve` prefetches the shapes of later
//             pairs.
//          2. Solve batches with a half-space by one support point (kernels/minkowski/halfspace).
//          3. For the batch's two kinds, select the compiled loops from a table (specialised_gjk).
//          4. Pairs whose bounding balls are apart are separated (not for distance).
//             So are hulls that the line of centres parts, for yes or no (kernels/gjk/first_plane).
//          5. Iterate with the selected loops (kernels/gjk/gjk_iteration, gjk_distance).
//          6. If the cores meet, find the depth with EPA (kernels/gjk/gjk_query).
// Departs: the loops are gjk's, compiled with the two cores as template parameters, so outcomes
//          have the bits of gjk's. Code that runs once per query and EPA are gjk's own, with the
//          switch. The search in a hull depends on the hull. It always starts cold.
// Answers: like gjk, with its resolution.
// Fails:   like gjk.
// Cost:    like gjk, without the switch; 28 copies of the iteration for each scalar and each level
//          of vector instructions, in the program and in the time to compile it.
#include <algorithm>

#include "algorithms/kernels/batch/for_each_pair.h"
#include "algorithms/kernels/gjk/gjk_query.h"
#include "algorithms/narrow_phase.h"
#include "algorithms/narrow_phase/gjk_templated/specialised_gjk.h"

namespace touchstone {
namespace {

std::size_t core_of(ShapeKind kind) {
  SupportCore core = SupportCore::halfspace;
  switch (kind) {
    case ShapeKind::sphere: core = SupportCore::point; break;
    case ShapeKind::capsule: core = SupportCore::segment; break;
    case ShapeKind::box: core = SupportCore::box; break;
    case ShapeKind::cylinder: core = SupportCore::cylinder; break;
    case ShapeKind::cone: core = SupportCore::cone; break;
    case ShapeKind::ellipsoid: core = SupportCore::ellipsoid; break;
    case ShapeKind::hull: core = SupportCore::hull; break;
    case ShapeKind::halfspace: break;
  }
  return static_cast<std::size_t>(core);
}

template <class Scalar>
class GjkTemplated final : public NarrowPhase {
 public:
  explicit GjkTemplated(const GjkQuerySettings& settings) : query_(settings) {}

  void bind(std::span<const Shape> shapes) override {
    shapes_ = make_support_shapes<Scalar>(shapes);
    ahead_.bind(shapes_);
  }

  void solve(Task task, const PairBatch& batch, std::span<Outcome> outcomes) override {
    if (batch.kind_b != ShapeKind::halfspace) {
      query_.set_functions(functions_[core_of(batch.kind_a)][core_of(batch.kind_b)]);
    }
    for_each_bounded_pair(task, batch, shapes_, ahead_, asks_distance(task), outcomes,
                          [&](std::size_t i, const auto&... bodies) {
                            query_.solve(bodies..., task, nullptr, outcomes[i]);
                          });
  }

 private:
  const CoreTable<Scalar> functions_ = specialised_functions<Scalar>();
  GjkQuery<Scalar> query_;
  std::vector<SupportShape<Scalar>> shapes_;
  ShapePrefetch<Scalar> ahead_;
};

std::unique_ptr<NarrowPhase> make(const NarrowPhaseSettings& settings) {
  GjkQuerySettings own{.tolerance = settings.tolerance, .duality_gap = settings.duality_gap};
  own.margin = settings.margin.value_or(own.margin);
  own.gjk_cap = std::max(1, settings.max_iterations.value_or(own.gjk_cap));
  own.epa_cap = std::max(1, settings.max_iterations.value_or(own.epa_cap));
  if (settings.scalar == Precision::float32) return std::make_unique<GjkTemplated<float>>(own);
  return std::make_unique<GjkTemplated<double>>(own);
}

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<NarrowPhaseEntry> narrow_phase_gjk_templated() {
  return {{.info = {.name = "gjk-templated",
                    .citation = "Gilbert, Johnson, Keerthi, \"A fast procedure for computing the "
                                "distance between complex objects in three-dimensional space\", "
                                "IEEE J. Robotics and Automation 4(2), 1988; van den Bergen, "
                                "\"Proximity queries and penetration depth computation on 3D game "
                                "objects\", GDC 2001"},
           .tasks = {all_tasks.begin(), all_tasks.end()},
           .scalars = {Precision::float32, Precision::float64},
           .traits = {.stops_by_duality_gap = true},
           .tolerance = "the gap between both bounds on a distance or depth; 1e-10 (float 1e-5), "
                        "between polytopes what rounding allows",
           .make = make}};
}

}  // namespace touchstone::entries
