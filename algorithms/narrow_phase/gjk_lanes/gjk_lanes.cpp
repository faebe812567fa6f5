// GJK and EPA for many pairs at once: one pair per lane of vectors.
// Paper:   Gilbert, Johnson, Keerthi, IEEE J. Robotics and Automation 4(2), 1988; the nearest
//          feature of a simplex: Ericson, "Real-Time Collision Detection", 2005, section 9.5; van
//          den Bergen, GDC 2001, as in expanding_polytope.h.
// Steps:   0. With a memory, answer the pairs that the plane of the frame before still parts
//             (warm_planes), but for distances.
//          1. Load one pair per lane and rotate its bodies into the lane's frame (lane_start).
//             Pairs whose bounding balls are apart are separated at once.
//          2. Find the support point of every lane (lane_support).
//          3. Add it to the lane's simplex and select the feature nearest to the origin, for
//             simplices of all sizes together (lane_step).
//          4. A lane ends at a support plane that separates, at a tetrahedron that surely contains
//             the origin, at a point nearer than the radii, or when its bounds meet (lane_gjk).
//          5. Write the answers of ended lanes (lane_answer) and give these lanes the next pairs of
//             the batch.
//          6. For depths, keep the tetrahedra of up to 128 pairs and grow their polytopes in lanes
//             (lane_depths, lane_expand, bitset_hull).
//          7. Solve the pairs that the lanes leave open one by one, as `gjk` does
//             (kernels/gjk/gjk_query).
// Departs: every lane takes each step, whatever the size of its simplex: all regions are computed
//          and one is selected. Hulls of at most 16 vertices are rotated when their pair enters a
//          lane; larger ones are scanned sixteen vertices at a time, one lane after the other, in
//          double from 65 vertices on in floats first (kernels/minkowski/rough_scan). If the
//          origin is too close to a face of the tetrahedron, a point behind that face is tried.
//          In EPA nearest faces, visible faces and planes are computed for all lanes together,
//          horizons one by one.
//          In double, verdicts on cylinders, cones and ellipsoids are tried in lanes of floats
//          first, whose bounds prove them as well.
// Answers: bounded bodies. The lanes leave open hulls of more than 192 vertices or far from their
//          own origin, bodies whose matrix is not close to a rotation, and without AVX2 all pairs
//          in double (but for those verdicts), since two lanes per vector are slower than none.
//          Verdicts are as reliable as gjk's. Near contact they are gjk's own, with its resolution.
// Warm:    the plane that parted a pair, for verdicts and for depths of pairs that are apart; pairs
//          that are solved one by one start as gjk's do.
// Fails:   like gjk.
// Cost:    like gjk's iterations; all lanes take as long as the slowest. It pays from batches of
//          about four pairs. Depths take 0.4 to 0.7 of gjk's time in float and up to all of it in
//          double, less for hulls with fewer vertices. A pair whose polytope grows beyond 64
//          vertices is solved one by one from the start. A signed distance takes as long as all
//          distances, and the depths of the pairs that overlap. Caps and tolerance are gjk's.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <type_traits>

#include "algorithms/kernels/batch/warm_planes.h"
#include "algorithms/kernels/gjk/gjk_query.h"
#include "algorithms/narrow_phase.h"
#include "algorithms/narrow_phase/gjk_lanes/lane_gjk.h"
#include "algorithms/signed_by_two.h"

namespace touchstone {
namespace {

template <class Scalar>
class GjkInLanes final : public NarrowPhase {
 public:
  explicit GjkInLanes(const GjkQuerySettings& settings) : settings_(settings), query_(settings) {}

  void bind(std::span<const Shape> shapes) override {
    shapes_ = make_support_shapes<Scalar>(shapes);
    radii_.clear();
    for (const Body& shape : shapes_) radii_.push_back(radius_of(shape));
    lanes_.bind(shapes, shapes_);
    const auto is_curved = [](const Shape& shape) { return Lanes::is_curved(shape.kind); };
    if (std::is_same_v<Scalar, double> && std::ranges::any_of(shapes, is_curved)) {
      quick_shapes_ = make_support_shapes<float>(shapes);
      quick_.bind(shapes, quick_shapes_);
    }
  }

  void solve(Task task, const PairBatch& batch, std::span<Outcome> outcomes) override {
    if (task == Task::signed_distance) return signed_.solve(*this, batch, outcomes);
    left_.resize(std::max(left_.size(), batch.size()));
    const bool warm = WarmPlanes::may_answer(task, batch);
    const std::span<const std::uint32_t> places =
        warm ? planes_.answer(task, batch, true, outcomes) : all_places(batch.size());
    found_.clear();
    const bool curved = Lanes::is_curved(batch.kind_a) || Lanes::is_curved(batch.kind_b);
    const typename Lanes::Goal goal{.task = task,
                                    .tolerance = query_.tolerance(!curved),
                                    .most_iterations = settings_.gjk_cap,
                                    .most_expansions = settings_.epa_cap,
                                    .directions = warm ? planes_.directions() : nullptr,
                                    .planes = warm ? &found_ : nullptr};
    const std::size_t count = std::is_same_v<Scalar, double> && curved && task == Task::intersect
                                  ? decide_in_floats_first(batch, goal, places, outcomes)
                                  : lanes_.solve(batch.kind_a, batch.kind_b, batch.pairs, goal,
                                                 places, outcomes, left_.data());
    for (std::size_t k = 0; k < count; ++k) {
      solve_serially(task, batch, left_[k], warm, outcomes[left_[k]]);
    }
    if (warm) keep_planes(batch, places, outcomes);
  }

  void solve_alone(Task task, const PairBatch& batch, std::size_t i, Outcome& outcome) override {
    const bool warm = WarmPlanes::may_answer(task, batch);
    if (warm && WarmPlanes::answer_alone(task, batch, i, outcome)) return;
    if (Lanes::is_curved(batch.kind_a) || Lanes::is_curved(batch.kind_b)) {
      // One curved pair fills too little of the lanes.
      solve_serially(task, batch, i, !batch.memory.empty(), outcome);
    } else {
      NarrowPhase::solve_alone(task, batch, i, outcome);
    }
  }

 private:
  using Lanes = GjkLanes<Scalar>;
  using Body = SupportShape<Scalar>;

  // Verdicts of floats are proven for the same bodies, so doubles are for the pairs that floats leave
  // open. Returns the number of pairs in left_.
  std::size_t decide_in_floats_first(const PairBatch& batch, const typename Lanes::Goal& goal,
                                     std::span<const std::uint32_t> places,
                                     std::span<Outcome> outcomes) {
    open_.resize(std::max(open_.size(), batch.size()));
    const std::size_t open =
        quick_.solve(batch.kind_a, batch.kind_b, batch.pairs,
                     {.task = Task::intersect,
                      .most_iterations = std::min(most_quick_iterations, settings_.gjk_cap),
                      .planes = goal.planes},
                     places, outcomes, open_.data());
    return lanes_.solve(batch.kind_a, batch.kind_b, batch.pairs, goal, {open_.data(), open},
                        outcomes, left_.data());
  }

  // 0, 1, 2... as places of a whole batch.
  std::span<const std::uint32_t> all_places(std::size_t count) {
    while (places_.size() < count) places_.push_back(static_cast<std::uint32_t>(places_.size()));
    return {places_.data(), count};
  }

  void solve_serially(Task task, const PairBatch& batch, std::size_t i, bool warm,
                      Outcome& outcome) {
    const BodyPairs& pairs = batch.pairs;
    const std::uint32_t a = pairs.first[i], b = pairs.second[i];
    WarmStart start;
    if (warm) std::memcpy(&start, batch.memory[batch.memory_of[i]].bytes.data(), sizeof start);
    query_.solve(shapes_[pairs.shape_of[a]], pairs.poses[a], shapes_[pairs.shape_of[b]],
                 pairs.poses[b], task, warm ? &start : nullptr, outcome);
    if (warm) std::memcpy(batch.memory[batch.memory_of[i]].bytes.data(), &start, sizeof start);
  }

  // Keeps the planes that the lanes found, and, of pairs that needed no iteration, those across the
  // line of centres.
  void keep_planes(const PairBatch& batch, std::span<const std::uint32_t> places,
                   std::span<const Outcome> outcomes) {
    // These matrices lengthen no vector by more than this.
    constexpr double greatest_stretch = 1.7465;
    for (const std::uint32_t i : places) {
      if (outcomes[i].answer != Answer::separated || outcomes[i].iterations != 0) continue;
      const std::uint32_t a = batch.pairs.first[i], b = batch.pairs.second[i];
      const Body& body_a = shapes_[batch.pairs.shape_of[a]];
      const Body& body_b = shapes_[batch.pairs.shape_of[b]];
      const Pose &pose_a = batch.pairs.poses[a], &pose_b = batch.pairs.poses[b];
      if (!(pose_a.rotation.squaredNorm() < 3.05 && pose_b.rotation.squaredNorm() < 3.05)) continue;
      const Vec3d offset = centre_offset(body_a, pose_a, body_b, pose_b).vector;
      const double length = std::sqrt(offset.squaredNorm());
      const double gap =
          length - greatest_stretch * (body_a.size + body_a.radius + body_b.size + body_b.radius);
      if (gap > 0) found_.push_back({i, offset / length, gap});
    }
    for (const LanePlane& plane : found_) {
      const std::uint32_t a = batch.pairs.first[plane.place], b = batch.pairs.second[plane.place];
      WarmPlanes::keep(CarriedPlane::make(plane.normal, plane.gap, radii_[batch.pairs.shape_of[a]],
                                          batch.pairs.poses[a], radii_[batch.pairs.shape_of[b]],
                                          batch.pairs.poses[b]),
                       batch, plane.place);
    }
  }

  // Floats that take longer mostly end in doubt.
  static constexpr int most_quick_iterations = 16;

  GjkQuerySettings settings_;
  GjkQuery<Scalar> query_;
  std::vector<SupportShape<Scalar>> shapes_;
  std::vector<double> radii_;  // radius_of the shapes
  Lanes lanes_;
  SignedByTwo signed_;
  WarmPlanes planes_;
  // For double: the same in floats.
  std::vector<SupportShape<float>> quick_shapes_;
  GjkLanes<float> quick_;
  // Scratch: the pairs that the lanes leave open, and those that the lanes of floats do.
  std::vector<std::uint32_t> left_, open_;
  std::vector<std::uint32_t> places_;  // 0, 1, 2...
  std::vector<LanePlane> found_;       // scratch: planes for the pairs' memories
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

namespace touchstone::entries {

std::vector<NarrowPhaseEntry> narrow_phase_gjk_lanes() {
  return {{.info = {.name = "gjk-lanes",
                    .citation = "Gilbert, Johnson, Keerthi, \"A fast procedure for computing the "
                                "distance between complex objects in three-dimensional space\", "
                                "IEEE J. Robotics and Automation 4(2), 1988; Ericson, Real-Time "
                                "Collision Detection, 2005"},
           .tasks = {all_tasks.begin(), all_tasks.end()},
           .scalars = {Precision::float32, Precision::float64},
           .supports = takes,
           .traits = {.starts_warm = true},
           .tolerance = "the gap between both bounds on a distance or depth; what rounding allows",
           .make = make}};
}

}  // namespace touchstone::entries
