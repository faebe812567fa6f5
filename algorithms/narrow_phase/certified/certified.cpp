// Certified: GJK in doubles if a bound on its rounding proves the answer, integers otherwise.
// Paper:   Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric
//          predicates", Discrete & Computational Geometry 18, 1997 (a filter before exact
//          arithmetic); Gilbert, Johnson, Keerthi, 1988, as in gjk.cpp.
// Steps:   1. Half-space: bound the height of the lowest point over the plane, for a verdict in
//             doubles first, then in long double (halfspace_bounds).
//          2. Pairs whose bounding balls are apart are separated (not for distance).
//          3. intersect: run GJK's fast iteration; accept a support plane, a tetrahedron around the
//             origin or a point within the radii that holds by more than the
//             bound of proven_rounding.h.
//          4. Otherwise run GJK's distance loop; it may prove the verdict in the same ways.
//          5. From the last direction and simplex, compute an interval of the signed distance in
//             long double with all rounding bounded (distance_bounds, support_bounds).
//          6. Accept the interval if it decides and, for a distance or depth, is at most 4e-15 of
//             the size or 2 units in the last place wide.
//          7. Otherwise ask the oracle, in integers.
// Departs: the filter covers whole queries instead of predicates. The depth of cores that share a
//          point always comes from the oracle. Outcome::support_calls is -1 if the oracle answered,
//          and a count otherwise.
// Fails:   unknown / not_converged if the oracle's enclosure of curved cores contains zero, and
//          not_converged with bounds if that of a depth is wider than 1e-9 of the size. Never
//          wrong. Tolerance and iteration cap are ignored: they would only make it slower.
// Cost:    GJK's at gaps beyond rounding. The oracle takes 10 to 100 us, or some ms for distances
//          of curved cores that GJK does not settle and for all their depths.
#include <algorithm>
#include <limits>
#include <vector>

#include "algorithms/kernels/batch/for_each_pair.h"
#include "algorithms/kernels/gjk/gjk_distance.h"
#include "algorithms/kernels/gjk/gjk_iteration.h"
#include "algorithms/kernels/minkowski/support.h"
#include "algorithms/narrow_phase.h"
#include "algorithms/narrow_phase/certified/distance_bounds.h"
#include "algorithms/narrow_phase/certified/halfspace_bounds.h"
#include "algorithms/narrow_phase/certified/proven_rounding.h"
#include "algorithms/oracle/answer.h"

namespace touchstone {
namespace {

using Pair = SupportPair<double>;

constexpr int most_iterations = 128;
constexpr double widest = 4e-15;  // relative to the size: the widest accepted interval

constexpr double least_digits = 1e-9;  // relative to the size: a wider enclosure is not a number

// A shape prepared for each stage.
struct Prepared {
  explicit Prepared(const Shape& s) : proven(s), solid(s) {}

  BoundedShape proven;
  oracle::Solid solid;

  const SupportShape<double>& support() const { return proven.support; }
  double size() const { return support().size + support().radius; }
};

struct PlacedBody {
  const Prepared& shape;
  const Pose& pose;
};

bool is_asked(Task task, Answer answer) {
  return (task == Task::distance && answer == Answer::separated) ||
         (task == Task::penetration && answer == Answer::overlapping);
}

// Writes the answer, and the interval if the task asks for it. Returns false if the bounds do not
// decide, or if the interval is too wide.
bool write(const DistanceBounds& gap, double size, Task task, Outcome& outcome) {
  const Answer answer = gap.lower > 0   ? Answer::separated
                        : gap.upper < 0 ? Answer::overlapping
                                        : Answer::unknown;
  if (answer == Answer::unknown) return false;
  if (is_asked(task, answer)) {
    // The nearer end is used, since the other may be infinite.
    const double magnitude = std::min(std::abs(gap.lower), std::abs(gap.upper));
    const double enough =
        std::max(widest * size, 2 * std::numeric_limits<double>::epsilon() * magnitude);
    if (!(gap.upper - gap.lower <= enough)) return false;
    outcome.lower = gap.lower;
    outcome.upper = gap.upper;
    outcome.distance = gap.lower + (gap.upper - gap.lower) / 2;
  }
  outcome.answer = answer;
  outcome.status = Status::ok;
  return true;
}

class Certified final : public NarrowPhase {
 public:
  void bind(std::span<const Shape> shapes) override {
    shapes_.clear();
    shapes_.reserve(shapes.size());
    for (const Shape& shape : shapes) shapes_.emplace_back(shape);
    ahead_.bind(shapes_, &Prepared::support);
  }

  void solve(Task task, const PairBatch& batch, std::span<Outcome> outcomes) override {
    for_each_pair(batch.pairs, shapes_, ahead_, task == Task::distance,
                  [&](std::size_t i, const Prepared& a, const Pose& pose_a, const Prepared& b,
                      const Pose& pose_b) {
                    solve_pair({a, pose_a}, {b, pose_b}, task, batch, outcomes[i]);
                  });
  }

 private:
  // A call of it costs pairs far apart 4 % of their instructions.
  [[gnu::always_inline]] inline void solve_pair(const PlacedBody& a, const PlacedBody& b, Task task,
                                                const PairBatch& batch, Outcome& outcome);
  bool filter(const PlacedBody& a, const PlacedBody& b, Task task, Outcome& outcome);
  bool fast_gjk_decides(Pair& pair, Outcome& outcome) const;
  bool gjk_distance_decides(Pair& pair, const PlacedBody& a, const PlacedBody& b, Task task,
                            Outcome& outcome);
  bool on_plane(const PlacedBody& a, const PlacedBody& b, Task task, Outcome& outcome);

  std::vector<Prepared> shapes_;
  ShapePrefetch<double> ahead_;
  DistanceBounder gaps_;
  HalfspaceBounder heights_;
  oracle::Oracle oracle_;
};

bool say(Answer answer, Outcome& outcome) {
  outcome.answer = answer;
  outcome.status = Status::ok;
  return true;
}

void Certified::solve_pair(const PlacedBody& a, const PlacedBody& b, Task task,
                           const PairBatch& batch, Outcome& outcome) {
  outcome.iterations = outcome.support_calls = 0;
  const bool decided = batch.kind_a == ShapeKind::halfspace   ? false
                       : batch.kind_b == ShapeKind::halfspace ? on_plane(a, b, task, outcome)
                                                              : filter(a, b, task, outcome);
  if (decided) return;
  outcome.support_calls = -1;
  oracle::answer(oracle_, {a.shape.solid, a.pose}, {b.shape.solid, b.pose}, task, outcome);
  // The enclosure of round cores deep in each other may be wide: then it is a bound, not a depth.
  const double size = std::max(a.shape.size(), b.shape.size());
  const bool curved = a.shape.solid.is_curved() || b.shape.solid.is_curved();
  if (task == Task::penetration && curved && outcome.upper - outcome.lower > least_digits * size) {
    outcome.status = Status::not_converged;
  }
}

bool Certified::filter(const PlacedBody& a, const PlacedBody& b, Task task, Outcome& outcome) {
  if (task != Task::distance &&
      balls_are_apart(a.shape.support(), a.pose, b.shape.support(), b.pose)) {
    return say(Answer::separated, outcome);
  }
  Pair pair(a.shape.support(), a.pose, b.shape.support(), b.pose);
  const bool decided =
      is_in_range(pair) && ((task == Task::intersect && fast_gjk_decides(pair, outcome)) ||
                            gjk_distance_decides(pair, a, b, task, outcome));
  outcome.support_calls = pair.support_calls();
  return decided;
}

// Returns true if a point of the difference is certainly nearer to the origin than the radii.
bool is_within_radius(const Pair& pair, const Simplex<double>& simplex) {
  return pair.radius() > proven_rounding &&
         distance_from_origin(simplex) + proven_rounding < pair.radius();
}

// Tries the verdict of GJK's fast iteration.
bool Certified::fast_gjk_decides(Pair& pair, Outcome& outcome) const {
  FastGjkResult<double> found =
      fast_gjk(pair, {.only_apart = true, .most_iterations = most_iterations}, 0.0);
  outcome.iterations = found.iterations;
  switch (found.end) {
    case FastGjkEnd::apart:
      return found.lower > pair.radius() + proven_rounding && say(Answer::separated, outcome);
    case FastGjkEnd::inside: return say(Answer::overlapping, outcome);
    default: break;
  }
  if (pair.radius() == 0 || found.simplex.size == 0) return false;
  const NearestPoint<double> nearest = reduce_to_nearest(found.simplex);
  return !nearest.inside && is_within_radius(pair, found.simplex) &&
         say(Answer::overlapping, outcome);
}

// Runs GJK's distance loop and tests what its end proves.
bool Certified::gjk_distance_decides(Pair& pair, const PlacedBody& a, const PlacedBody& b,
                                     Task task, Outcome& outcome) {
  const GjkDistanceGoal<double> goal{
      .task = task == Task::penetration ? Task::penetration : Task::distance,
      .tolerance = 4 * std::numeric_limits<double>::epsilon(),
      .most_iterations = most_iterations};
  const GjkDistanceResult<double> found = gjk_distance(pair, goal);
  outcome.iterations += found.iterations;
  const Simplex<double>& simplex = found.simplex;
  if (found.nearest.inside) {
    return task != Task::penetration && simplex.size == 4 && is_surely_inside(simplex) &&
           say(Answer::overlapping, outcome);
  }
  if (task == Task::penetration && found.lower > pair.radius() + proven_rounding) {
    return say(Answer::separated, outcome);
  }
  if (task != Task::penetration && is_within_radius(pair, simplex)) {
    return say(Answer::overlapping, outcome);
  }
  const Vec3d normal = -found.nearest.direction;
  const DistanceBounds gap =
      gaps_.between(a.shape.proven, a.pose, b.shape.proven, b.pose, pair, simplex, normal);
  if (!write(gap, std::max(a.shape.size(), b.shape.size()), task, outcome)) return false;
  if (is_asked(task, outcome.answer)) {
    Vec3d on_a = Vec3d::Zero(), on_b = Vec3d::Zero();
    for (int i = 0; i < simplex.size; ++i) {
      on_a += simplex.weights[i] * simplex.points[i].a;
      on_b += simplex.weights[i] * simplex.points[i].b;
    }
    outcome.normal = normal;
    outcome.witness_a = pair.to_world(on_a + pair.radius_a() * normal);
    outcome.witness_b = pair.to_world(on_b - pair.radius_b() * normal);
  }
  return true;
}

// Solves a pair whose body b is a half-space.
bool Certified::on_plane(const PlacedBody& a, const PlacedBody& b, Task task, Outcome& outcome) {
  outcome.support_calls = 1;
  if (task == Task::intersect &&
      write(HalfspaceBounder::roughly(a.shape.proven, a.pose, b.shape.proven, b.pose),
            a.shape.size(), task, outcome)) {
    return true;
  }
  Vec3d outward;
  const DistanceBounds gap =
      heights_.closely(a.shape.proven, a.pose, b.shape.proven, b.pose, outward);
  if (!write(gap, a.shape.size(), task, outcome)) return false;
  if (is_asked(task, outcome.answer)) {
    const SupportShape<double>& shape = a.shape.support();
    const double unit = power_of_two_above(shape.reach(a.pose.rotation));
    PosedShape<double> turned(shape, a.pose.rotation, unit);
    outcome.normal = -outward;
    outcome.witness_a =
        a.pose(shape.centre) + unit * turned.support(-outward) - shape.radius * outward;
    outcome.witness_b = outcome.witness_a + outcome.distance * outcome.normal;
  }
  return true;
}

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<NarrowPhaseEntry> narrow_phase_certified() {
  return {{.info = {.name = "certified",
                    .citation = "Shewchuk, \"Adaptive precision floating-point arithmetic and fast "
                                "robust geometric predicates\", Discrete & Computational Geometry "
                                "18, 1997; Gilbert, Johnson, Keerthi, 1988"},
           .tasks = {Task::intersect, Task::distance, Task::penetration},
           .scalars = {Precision::float64},
           .make = [](const NarrowPhaseSettings&) { return std::make_unique<Certified>(); }}};
}

}  // namespace touchstone::entries
