// Cylinders, cones, ellipsoids and capsules by Newton's method on the normal.
// Paper:   Absil, Mahony, Sepulchre, "Optimization Algorithms on Matrix Manifolds", 2008, ch. 6
//          (Newton on the sphere); Gilbert, Johnson, Keerthi, IEEE J. Robotics and Automation 4(2),
//          1988 (verdicts and the start); van den Bergen, GDC 2001 (the polytope).
// Steps:   1. depth: pairs whose bounding balls are apart are separated.
//          2. intersect: try the line of centres and three planes (quick_verdict); then as `gjk`
//             (kernels/gjk/gjk_query).
//          3. GJK, with a tolerance of a third of the size, tells whether the cores meet.
//          4. Descend from its normal, or from that of the nearest face of its tetrahedron, to a
//             normal at which the height of the difference is stationary (smooth_foot).
//          5. Cores that are apart: the height and the point of the difference on the normal enclose
//             their distance, and so the depth of the balls around them.
//          6. Cores that meet: prove that no other height is less, close to the normal by curvature and
//             elsewhere by a polytope (least_overlap).
//          7. What is not proven is solved as `gjk` does. A signed distance goes by step 5 or 6, as GJK
//             tells.
// Departs: the normal is searched where two ends of a body tie, or a disc is flat, too: active sets,
//          with the balance of the tied points as their multipliers.
// Warm:    the plane that parted a pair at a verdict, or instead of a depth (warm_planes).
// Answers: spheres, capsules, cylinders, cones and ellipsoids with each other. Poses that are not
//          rotations up to 1e-12, and depths and distances without curved bodies, or of a sphere and a
//          cylinder or cone, are gjk's.
// Fails:   like gjk where a second normal is as good to 1e-12, as between coaxial bodies: the answer
//          is gjk's, with its tolerance of 1e-10.
// Cost:    O(1); GJK, about 10 support calls of Newton's method, and about 20 points of a polytope.
//          Caps: 128 iterations of GJK, 96 points. Tolerance relative to the size: 1e-12.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <optional>

#include "algorithms/kernels/batch/for_each_pair.h"
#include "algorithms/kernels/batch/warm_planes.h"
#include "algorithms/kernels/gjk/gjk_query.h"
#include "algorithms/narrow_phase.h"
#include "algorithms/narrow_phase/smooth/least_overlap.h"
#include "algorithms/narrow_phase/smooth/quick_verdict.h"

namespace touchstone {
namespace {

constexpr int default_point_cap = 96;

class SmoothNormals final : public NarrowPhase {
 public:
  SmoothNormals(const GjkQuerySettings& settings, double tolerance, int point_cap)
      : settings_(settings), tolerance_(tolerance), query_(settings), search_(point_cap) {}

  void bind(std::span<const Shape> shapes) override {
    shapes_ = make_support_shapes<double>(shapes);
    ahead_.bind(shapes_);
    // GJK between the cores alone ends as soon as their distance is known.
    cores_ = shapes_;
    for (Body& core : cores_) core.radius = 0;
    round_.clear();
    for (const Shape& shape : shapes) round_.emplace_back(shape);
  }

  void solve(Task task, const PairBatch& batch, std::span<Outcome> outcomes) override {
    if (WarmPlanes::may_answer(task, batch, settings_.margin)) {
      for (const std::uint32_t i : planes_.answer(task, batch, false, outcomes, settings_.margin)) {
        solve_warm(task, batch, i, outcomes[i]);
      }
      return;
    }
    if (task == Task::intersect) {
      for (std::size_t i = 0; i < batch.size(); ++i) decide(batch.pairs, i, nullptr, outcomes[i]);
      return;
    }
    for_each_bounded_pair(task, batch, shapes_, ahead_, asks_distance(task), outcomes,
                          [&](std::size_t i, const auto&... bodies) {
                            solve_pair(task, bodies..., nullptr, outcomes[i]);
                          });
  }

  void solve_alone(Task task, const PairBatch& batch, std::size_t i, Outcome& outcome) override {
    if (WarmPlanes::may_answer(task, batch, settings_.margin)) {
      if (!WarmPlanes::answer_alone(task, batch, i, outcome, settings_.margin)) {
        solve_warm(task, batch, i, outcome);
      }
    } else if (task == Task::intersect) {
      decide(batch.pairs, i, nullptr, outcome);
    } else {
      for_bounded_pair(task, batch, i, shapes_, outcome, [&](std::size_t, const auto&... bodies) {
        solve_pair(task, bodies..., nullptr, outcome);
      });
    }
  }

 private:
  using Body = SupportShape<double>;
  static constexpr double rounding = SupportPair<double>::rounding;

  // The cores of a pair, and the radii of the balls around them in its unit.
  struct Cores {
    Cores(const Body& a, const Body& core_a, const Pose& pose_a, const Body& b, const Body& core_b,
          const Pose& pose_b)
        : pair(core_a, pose_a, core_b, pose_b),
          radius_a(a.radius / pair.unit()),
          radius_b(b.radius / pair.unit()) {}

    double radius() const { return radius_a + radius_b; }
    SupportPair<double> pair;
    double radius_a, radius_b;
  };

  // Solves a pair whose plane was tried, and does not part it.
  void solve_warm(Task task, const PairBatch& batch, std::size_t i, Outcome& outcome) {
    PairMemory& memory = batch.memory[batch.memory_of[i]];
    WarmStart start;
    std::memcpy(&start, memory.bytes.data(), sizeof start);
    if (task == Task::intersect) {
      decide(batch.pairs, i, &start, outcome);
    } else {
      for_bounded_pair(task, batch, i, shapes_, outcome, [&](std::size_t, const auto&... bodies) {
        solve_pair(task, bodies..., &start, outcome);
      });
    }
    std::memcpy(memory.bytes.data(), &start, sizeof start);
  }

  // `start` is null or the pair's memory, whose plane does not part the pair.
  void decide(const BodyPairs& pairs, std::size_t i, WarmStart* start, Outcome& outcome) {
    const std::uint32_t first = pairs.first[i], second = pairs.second[i];
    const std::uint32_t a = pairs.shape_of[first], b = pairs.shape_of[second];
    const Pose &pose_a = pairs.poses[first], &pose_b = pairs.poses[second];
    const QuickVerdict quick = quick_verdict(round_[a], pose_a, round_[b], pose_b);
    if (quick.answer != Answer::unknown) {
      outcome.answer = quick.answer;
      outcome.status = Status::ok;
      outcome.iterations = outcome.support_calls = quick.planes;
      if (start != nullptr && quick.answer == Answer::separated) {
        const double length = std::sqrt(quick.normal.squaredNorm());
        start->plane =
            CarriedPlane::make(quick.normal / length, quick.gap / length, radius_of(shapes_[a]),
                               pose_a, radius_of(shapes_[b]), pose_b);
      }
      return;
    }
    query_.solve(shapes_[a], pose_a, shapes_[b], pose_b, Task::intersect, start, outcome);
  }

  void solve_pair(Task task, const Body& a, const Pose& pose_a, const Body& b, const Pose& pose_b,
                  WarmStart* start, Outcome& outcome) {
    // GJK ends between a point and a flat or ruled surface as soon.
    const bool curved = a.core == SupportCore::point ? b.core == SupportCore::ellipsoid
                                                     : !a.is_polytope() || !b.is_polytope();
    const bool apart = task == Task::penetration && balls_are_apart(a, pose_a, b, pose_b);
    if (curved && !apart && is_rotation(pose_a.rotation) && is_rotation(pose_b.rotation) &&
        solve_curved(task, a, pose_a, b, pose_b, start, outcome)) {
      return;
    }
    query_.solve(a, pose_a, b, pose_b, task, start, outcome);
  }

  // Returns false if the answer is gjk's to find.
  bool solve_curved(Task task, const Body& a, const Pose& pose_a, const Body& b, const Pose& pose_b,
                    WarmStart* start, Outcome& outcome) {
    using End = GjkDistanceResult<double>::End;
    constexpr double coarse = 0.3;
    const auto core_of = [&](const Body& body) -> const Body& {
      return cores_[static_cast<std::size_t>(&body - shapes_.data())];
    };
    Cores cores(a, core_of(a), pose_a, b, core_of(b), pose_b);
    SupportPair<double>& pair = cores.pair;
    // The distance of cores within balls is wanted, whatever the task.
    const bool to_distance = cores.radius() > 0 || asks_distance(task);
    const GjkDistanceGoal<double> goal{.task = to_distance ? Task::distance : task,
                                       .tolerance = coarse,
                                       .most_iterations = settings_.gjk_cap};
    const GjkDistanceResult<double> found = gjk_distance(pair, goal);
    outcome.iterations = found.iterations;
    if (found.end == End::contact) {
      return asks_depth(task) && found.nearest.inside && solve_depth(cores, found.simplex, outcome);
    }
    const double lower = found.lower - cores.radius();
    if (task == Task::penetration && lower > rounding) {
      outcome.answer = Answer::separated;
      outcome.status = Status::ok;
      outcome.support_calls = pair.support_calls();
      if (start != nullptr) {
        // The normal's length is off by rounding as well as the bound.
        start->plane = CarriedPlane::make(found.direction, pair.unit() * (lower - 2 * rounding),
                                          radius_of(a), pose_a, radius_of(b), pose_b);
      }
      return true;
    }
    return solve_apart(task, cores, -found.nearest.direction, outcome);
  }

  // Cores that are apart: their height has one negative minimum, and the foot's point is the nearest.
  bool solve_apart(Task task, Cores& cores, const Vec3d& normal, Outcome& outcome) const {
    if (!(normal.squaredNorm() > 0.5)) return false;
    const SmoothPair smooth(cores.pair);
    const std::optional<SmoothFoot> foot = find_foot(smooth, normal, false);
    if (!foot) return false;
    const double lower = -foot->height, upper = std::sqrt(foot->nearest.squaredNorm());
    if (!(lower > 4 * rounding) || !(upper - lower < tolerance_)) return false;
    const double radius = cores.radius();
    if (lower - radius > rounding) {
      outcome.answer = Answer::separated;
    } else if (upper - radius < -rounding) {
      outcome.answer = Answer::overlapping;
    } else {
      return false;
    }
    outcome.status = Status::ok;
    outcome.support_calls = cores.pair.support_calls() + foot->support_calls;
    const bool asked = outcome.answer == Answer::separated ? asks_distance(task) : asks_depth(task);
    if (asked) write(cores, *foot, upper, lower, upper, outcome);
    return true;
  }

  bool solve_depth(Cores& cores, const Simplex<double>& simplex, Outcome& outcome) {
    const std::optional<LeastOverlap> least = search_.find(cores.pair, simplex, tolerance_);
    if (!least || !(least->lower > rounding)) return false;
    outcome.answer = Answer::overlapping;
    outcome.iterations += least->iterations;
    const SmoothFoot& foot = least->foot;
    write(cores, foot, -foot.height, -foot.height, -least->lower, outcome);
    return true;
  }

  // Writes signed distances of the cores.
  static void write(const Cores& cores, const SmoothFoot& foot, double distance, double lower,
                    double upper, Outcome& outcome) {
    const SupportPair<double>& pair = cores.pair;
    const double unit = pair.unit(), radius = cores.radius();
    outcome.status = Status::ok;
    outcome.distance = unit * (distance - radius);
    outcome.lower = unit * (lower - radius - rounding);
    outcome.upper = unit * (upper - radius + rounding);
    outcome.normal = foot.normal;
    // The points that the balance chose; b's is on the mirrored core.
    const Vec3d on_a = foot.a.point(), on_b = pair.centre_b() - foot.b.point();
    outcome.witness_a = pair.to_world(on_a + cores.radius_a * foot.normal);
    outcome.witness_b = pair.to_world(on_b - cores.radius_b * foot.normal);
    outcome.support_calls = pair.support_calls() + foot.support_calls;
  }

  GjkQuerySettings settings_;
  double tolerance_;  // in the pair's unit, which is up to twice its size
  GjkQuery<double> query_;
  LeastOverlapSearch search_;
  std::vector<Body> shapes_, cores_;
  std::vector<RoundShape> round_;
  ShapePrefetch<double> ahead_;
  WarmPlanes planes_;
};

bool takes(ShapeKind a, ShapeKind b, Task) {
  const auto is_round = [](ShapeKind kind) {
    return kind <= ShapeKind::ellipsoid && kind != ShapeKind::box;
  };
  return is_round(a) && is_round(b);
}

std::unique_ptr<NarrowPhase> make(const NarrowPhaseSettings& settings) {
  GjkQuerySettings own{.tolerance = settings.tolerance};
  own.gjk_cap = std::max(1, settings.max_iterations.value_or(own.gjk_cap));
  own.epa_cap = std::max(1, settings.max_iterations.value_or(own.epa_cap));
  const double tolerance =
      std::max(settings.tolerance.value_or(1e-12) / 2, 32 * SupportPair<double>::rounding);
  const int points = std::max(4, settings.max_iterations.value_or(default_point_cap));
  return std::make_unique<SmoothNormals>(own, tolerance, points);
}

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<NarrowPhaseEntry> narrow_phase_smooth() {
  return {{.info = {.name = "smooth",
                    .citation = "Gilbert, Johnson, Keerthi, 1988; Newton's method on the sphere of "
                                "normals: Absil, Mahony, Sepulchre, \"Optimization Algorithms on "
                                "Matrix Manifolds\", 2008"},
           .tasks = {all_tasks.begin(), all_tasks.end()},
           .scalars = {Precision::float64},
           .supports = takes,
           .traits = {.starts_warm = true},
           .tolerance =
               "the gap between both bounds on a distance or depth; 1e-12, and gjk's 1e-10 "
               "where it answers",
           .make = make}};
}

}  // namespace touchstone::entries
