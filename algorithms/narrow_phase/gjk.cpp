// GJK: moves a simplex on the difference A - B towards the origin, one support point at a time; EPA
// finds the depth.
// Paper:   Gilbert, Johnson, Keerthi, IEEE J. Robotics and Automation 4(2), 1988; sub-distance of
//          Montanari, Petrinic, Barbieri, ACM TOG 36(3), 2017; depth: van den Bergen, GDC 2001.
// Steps:   1. A half-space takes one support point (kernels/minkowski/halfspace).
//          2. Pairs whose bounding balls are apart are separated (not for distance).
//          3. With a memory, try the last separating plane before anything else, as both bodies
//             carry it (kernels/gjk/carried_plane), for all pairs of a batch in lanes (kernels/batch/warm_planes);
//             then the last tetrahedron, plane or simplex
//             (kernels/gjk/warm_start).
//          4. Iterate fast with plain products (kernels/gjk/gjk_iteration); between polytopes its
//             verdict is enough. Its first plane is tried before the pair is prepared for more, if
//             one is a hull and the centres are far enough apart (kernels/gjk/first_plane). Between a box and a
//             hull it starts towards the box's place that is nearest to the hull's centre. Where the hull
//             rests on a face of the box, it ends there (kernels/gjk/box_face).
//          5. Continue in the distance loop, where each simplex bounds the distance from above and
//             each support plane from below, until the bounds decide (kernels/gjk/gjk_distance).
//          6. If the origin is in the cores' difference, a triangle of the simplex whose plane supports
//             the difference at the origin bounds the signed distance on both sides
//             (kernels/gjk/simplex_face). Else EPA finds the depth or proves the verdict
//             (kernels/epa/expanding_polytope).
//          7. Subtract the radii and write the outcome; a verdict is `ok` only if a bound proves it
//             beyond rounding (kernels/gjk/gjk_query).
// Departs: stops by the duality gap of the distance, relative to the size, or by the absolute gap
//          of the squared distance that Montaut et al. use (NarrowPhaseSettings::duality_gap).
//          Round shapes are cores with a radius, so that their shallow overlaps need no EPA. If the
//          origin is too near the face that the search came through, a point behind that face is
//          tried. Hulls of more than 192 vertices find support points by a cube map
//          (kernels/minkowski/support_cube_map) instead of hill climbing, others by a look at all
//          vertices; from 65 on, in double, floats leave the few that doubles decide between
//          (kernels/minkowski/rough_scan). gjk-nesterov searches
//          along a direction with momentum (Montaut, Le Lidec, Petrik, Sivic, Carpentier,
//          "Collision detection accelerated: an optimization perspective", RSS 2022, algorithm 3;
//          its normalised form if a core has corners) until that makes no progress, and continues
//          as plain GJK. gjk-switched does so only between bodies without corners that are less
//          than about their size apart, where the fast iteration leaves them open, or with a duality
//          gap.
// Answers: `touching`, with bounds on the signed distance for every task, if the bounds enclose
//          zero and are at most 2.9e-14 (double) or 1.6e-5 (float) of the pair's unit apart, which
//          is at most twice its size (kernels/minkowski/resolution).
//          A signed distance is searched as a distance, and goes to EPA where the cores meet. A
//          distance ends at the first plane, carried one or bounding balls that part the bodies by
//          more than the margin.
// Warm:    gjk starts from a PairMemory, except EPA; the others start cold.
// Fails:   unknown / not_converged where the bounds enclose zero and are further apart, as between
//          slivers and between smooth bodies that touch. The depth of smooth, nearly round bodies
//          far inside each other reaches EPA's cap first: not_converged with bounds.
// Cost:    O(1) space; a few support calls for each digit on smooth shapes, finite on polytopes.
//          Caps: 128 iterations of GJK, 256 of EPA. Tolerance relative to the size: 1e-10 (double)
//          or 1e-5 (float); polytopes continue until only rounding is left.
#include <algorithm>
#include <cstring>
#include <type_traits>

#include "algorithms/kernels/batch/for_each_pair.h"
#include "algorithms/kernels/batch/warm_planes.h"
#include "algorithms/kernels/gjk/gjk_query.h"
#include "algorithms/narrow_phase.h"

namespace touchstone {
namespace {

template <class Scalar>
class Gjk final : public NarrowPhase {
 public:
  explicit Gjk(const GjkQuerySettings& settings)
      : warm_(settings.momentum == Momentum::none), margin_(settings.margin), query_(settings) {}

  void bind(std::span<const Shape> shapes) override {
    shapes_ = make_support_shapes<Scalar>(shapes);
    ahead_.bind(shapes_);
  }

  void solve(Task task, const PairBatch& batch, std::span<Outcome> outcomes) override {
    if (warm_ && WarmPlanes::may_answer(task, batch, margin_)) {
      const std::span<const std::uint32_t> places =
          planes_.answer(task, batch, false, outcomes, margin_);
      for_each_pair(planes_.others(batch).pairs, shapes_, ahead_, asks_distance(task),
                    [&](std::size_t k, const auto&... bodies) {
                      solve_warm(task, batch, places[k], bodies..., outcomes[places[k]]);
                    });
      return;
    }
    for_each_bounded_pair(task, batch, shapes_, ahead_, asks_distance(task), outcomes,
                          [&](std::size_t i, const auto&... bodies) {
                            solve_pair(task, batch, i, bodies..., outcomes[i]);
                          });
  }

  void solve_alone(Task task, const PairBatch& batch, std::size_t i, Outcome& outcome) override {
    const bool warm = warm_ && WarmPlanes::may_answer(task, batch, margin_);
    if (warm && WarmPlanes::answer_alone(task, batch, i, outcome, margin_)) return;
    for_bounded_pair(task, batch, i, shapes_, outcome, [&](std::size_t, const auto&... bodies) {
      solve_pair(task, batch, i, bodies..., outcome);
    });
  }

 private:
  void solve_pair(Task task, const PairBatch& batch, std::size_t i, const SupportShape<Scalar>& a,
                  const Pose& pose_a, const SupportShape<Scalar>& b, const Pose& pose_b,
                  Outcome& outcome) {
    if (!warm_ || batch.memory.empty()) {
      query_.solve(a, pose_a, b, pose_b, task, nullptr, outcome);
      return;
    }
    solve_warm(task, batch, i, a, pose_a, b, pose_b, outcome);
  }

  void solve_warm(Task task, const PairBatch& batch, std::size_t i, const SupportShape<Scalar>& a,
                  const Pose& pose_a, const SupportShape<Scalar>& b, const Pose& pose_b,
                  Outcome& outcome) {
    PairMemory& memory = batch.memory[batch.memory_of[i]];
    static_assert(sizeof(WarmStart) <= sizeof memory.bytes &&
                  std::is_trivially_copyable_v<WarmStart>);
    WarmStart start;
    std::memcpy(&start, memory.bytes.data(), sizeof start);
    query_.solve(a, pose_a, b, pose_b, task, &start, outcome);
    std::memcpy(memory.bytes.data(), &start, sizeof start);
  }

  bool warm_;
  double margin_;  // metres
  WarmPlanes planes_;
  GjkQuery<Scalar> query_;
  std::vector<SupportShape<Scalar>> shapes_;
  ShapePrefetch<Scalar> ahead_;
};

template <Momentum momentum>
std::unique_ptr<NarrowPhase> make(const NarrowPhaseSettings& settings) {
  GjkQuerySettings own{
      .tolerance = settings.tolerance, .duality_gap = settings.duality_gap, .momentum = momentum};
  own.margin = settings.margin.value_or(own.margin);
  own.gjk_cap = std::max(1, settings.max_iterations.value_or(own.gjk_cap));
  own.epa_cap = std::max(1, settings.max_iterations.value_or(own.epa_cap));
  if (settings.scalar == Precision::float32) return std::make_unique<Gjk<float>>(own);
  return std::make_unique<Gjk<double>>(own);
}

NarrowPhaseEntry entry(AlgorithmInfo info, bool starts_warm,
                       std::unique_ptr<NarrowPhase> (*make)(const NarrowPhaseSettings&)) {
  return {.info = std::move(info),
          .tasks = {all_tasks.begin(), all_tasks.end()},
          .scalars = {Precision::float32, Precision::float64},
          .traits = {.stops_by_duality_gap = true, .starts_warm = starts_warm},
          .tolerance =
              "the gap between both bounds on a distance or depth; 1e-10 (float 1e-5), "
              "between polytopes what rounding allows",
          .make = make};
}

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<NarrowPhaseEntry> narrow_phase_gjk() {
  const std::string depth =
      "; van den Bergen, \"Proximity queries and penetration depth computation on 3D game "
      "objects\", GDC 2001";
  return {
      entry({.name = "gjk",
             .citation = "Gilbert, Johnson, Keerthi, \"A fast procedure for computing the "
                         "distance between complex objects in three-dimensional space\", IEEE "
                         "J. Robotics and Automation 4(2), 1988" +
                         depth},
            true, make<Momentum::none>),
      entry({.name = "gjk-nesterov",
             .citation = "Montaut, Le Lidec, Petrik, Sivic, Carpentier, \"Collision detection "
                         "accelerated: an optimization perspective\", RSS 2022" +
                         depth},
            false, make<Momentum::nesterov>),
      entry({.name = "gjk-switched",
             .citation = "Gilbert, Johnson, Keerthi, 1988, and where bodies are smooth and near "
                         "Montaut, Le Lidec, Petrik, Sivic, Carpentier, RSS 2022" +
                         depth},
            false, make<Momentum::where_it_pays>)};
}

}  // namespace touchstone::entries
