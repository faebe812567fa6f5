// GJK and EPA, many pairs at once: one pair a lane of vectors.
// Paper:   Gilbert, Johnson, Keerthi, IEEE J. Robotics and Automation 4(2), 1988; the nearest
//          feature of a simplex: Ericson, "Real-Time Collision Detection", 2005, section 9.5; van
//          den Bergen, GDC 2001, as in expanding_polytope.h.
// Departs: every lane takes each step, whatever the size of its simplex: the regions of all
//          features are looked at, and one is selected. Lanes whose pairs are answered take the
//          next pairs of the batch. Vertices of hulls of up to 16 are turned into the frame of the
//          walk when a pair enters its lane; those of greater ones are scanned, sixteen at a time,
//          one lane after the other. Where the origin is too near the face of a tetrahedron to be
//          inside for sure, a corner behind that face is looked for, and one of the three
//          tetrahedra around the axis to it is. For depths the tetrahedra of 128 pairs are kept and
//          their polytopes grown in lanes: nearest faces, visible faces and planes of all at once,
//          horizons (small_surface.h) one by one. What rounding leaves open, and whatever the lanes
//          do not take, is asked again one by one as `gjk` does: the verdicts are as reliable as
//          those.
//          Takes spheres, capsules, boxes and hulls. One by one go hulls of more than 192 vertices
//          or far from their own origin, bodies whose matrix is no rotation nor near one, and,
//          where there is no AVX2, all pairs in double: two lanes a vector are slower than none.
// Fails:   as gjk: unknown / not_converged within 1e-14 (double) or 5e-6 (float) of touching, as a
//          part of the pair's size.
// Cost:    as gjk's walk, for all lanes what the slowest of them costs; pays from batches of about
//          four pairs on. Depths take 0.4 to 0.7 of gjk's time in float and up to all of it in
//          double, the less the fewer vertices the hulls have; a pair whose polytope grows beyond
//          64 vertices is asked one by one from the start. Caps and tolerance are gjk's.
#include <algorithm>

#include "algorithms/kernels/gjk/gjk_query.h"
#include "algorithms/narrow_phase.h"
#include "algorithms/narrow_phase/gjk_lanes/lane_gjk.h"

namespace touchstone {
namespace {

template <class Scalar>
class GjkInLanes final : public NarrowPhase {
 public:
  explicit GjkInLanes(const GjkQuerySettings& settings) : settings_(settings), query_(settings) {}

  void bind(std::span<const Shape> shapes) override {
    shapes_ = make_support_shapes<Scalar>(shapes);
    lanes_.bind(shapes, shapes_);
  }

  void solve(const PairBatch& batch, std::span<Outcome> outcomes) override {
    left_.resize(std::max(left_.size(), batch.size()));
    const std::size_t count = lanes_.solve(batch.kind_a, batch.kind_b,
                                           {batch.first, batch.second, batch.shape_of, batch.poses},
                                           {.task = batch.task,
                                            .tolerance = query_.tolerance(true),
                                            .most_iterations = settings_.gjk_cap,
                                            .most_expansions = settings_.epa_cap},
                                           outcomes, left_.data());
    for (std::size_t k = 0; k < count; ++k) {
      const std::uint32_t i = left_[k];
      const std::uint32_t a = batch.first[i], b = batch.second[i];
      query_.solve(shapes_[batch.shape_of[a]], batch.poses[a], shapes_[batch.shape_of[b]],
                   batch.poses[b], batch.task, nullptr, outcomes[i]);
    }
  }

 private:
  GjkQuerySettings settings_;
  GjkQuery<Scalar> query_;
  std::vector<SupportShape<Scalar>> shapes_;
  GjkLanes<Scalar> lanes_;
  std::vector<std::uint32_t> left_;  // scratch: the pairs that the lanes leave
};

std::unique_ptr<NarrowPhase> make(const NarrowPhaseSettings& settings) {
  GjkQuerySettings own{.tolerance = settings.tolerance};
  own.gjk_cap = std::max(1, settings.max_iterations.value_or(own.gjk_cap));
  own.epa_cap = std::max(1, settings.max_iterations.value_or(own.epa_cap));
  if (settings.scalar == Precision::float32) return std::make_unique<GjkInLanes<float>>(own);
  return std::make_unique<GjkInLanes<double>>(own);
}

bool takes(ShapeKind a, ShapeKind b, Task) {
  return GjkLanes<double>::takes(a) && GjkLanes<double>::takes(b);
}

}  // namespace
}  // namespace touchstone

TOUCHSTONE_NARROW_PHASE {
  using namespace touchstone;
  return {{.info = {.name = "gjk-lanes",
                    .citation = "Gilbert, Johnson, Keerthi, \"A fast procedure for computing the "
                                "distance between complex objects in three-dimensional space\", "
                                "IEEE J. Robotics and Automation 4(2), 1988; Ericson, Real-Time "
                                "Collision Detection, 2005"},
           .tasks = {Task::intersect, Task::distance, Task::penetration},
           .scalars = {Precision::float32, Precision::float64},
           .supports = takes,
           .make = make}};
}
