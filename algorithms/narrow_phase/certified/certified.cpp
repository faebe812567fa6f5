// Certified: GJK in doubles if a bound on its rounding proves the answer, integers otherwise.
// Paper:   Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric
//          predicates", Discrete & Computational Geometry 18, 1997 (a filter before exact
//          arithmetic); Gilbert, Johnson, Keerthi, 1988, as in gjk.cpp.
// Steps:   1. Half-space: bound the height of the lowest point over the plane, for a verdict in
//             doubles first, then in long double (halfspace_bounds).
//          2. Pairs whose bounding balls are apart are separated (not for distance). Boxes that stand
//             level, on each other or on a half-space, are decided by exact sums (level_contact).
//          3. intersect: run GJK's fast iteration; accept a support plane, a tetrahedron around the
//             origin or a point within the radii that holds by more than the bound of
//             proven_rounding.h. Otherwise run GJK's distance loop, which may prove the verdict in
//             the same ways.
//          4. Where that leaves the verdict of two polytopes open, decide it in integers, from the
//             few vertices near the plane of contact (exact_contact), or else by EPA's faces if
//             they surely enclose the origin. Rounded polytopes and half-spaces are decided in
//             integers where the bounds of step 5 leave it open.
//          5. distance: GJK's support plane and nearest point bound the signed distance from both
//             sides, in doubles (double_bounds). Where that is too wide, compute an interval from
//             the last direction and simplex in long double (distance_bounds, support_bounds).
//          6. The depth of polytopes: run EPA. The support along its nearest face bounds the
//             depth from above; that its faces enclose a ball bounds it from below. In doubles
//             first, too.
//          7. Accept an interval if it decides and, for a distance or depth, is at most the
//             tolerance (2e-13, if no other is set) of the greater body's size, or 2 units in the
//             last place, wide. No tolerance is taken to be below 4e-15.
//          8. Otherwise ask the oracle, in integers.
// Departs: the filter covers whole queries instead of predicates. The depth of rounded and curved
//          cores that share a point always comes from the oracle. Outcome::support_calls is -1 if
//          the oracle answered, and a count otherwise.
// Fails:   unknown / not_converged if the oracle's enclosure of curved cores contains zero, and
//          not_converged with bounds if that of a depth is wider than 1e-9 of the size. Never
//          wrong. The iteration cap is ignored: it would only make it slower.
// Cost:    GJK's and EPA's, and half a microsecond for bounds or one for exact signs. The oracle
//          takes 10 to 100 us, or some ms for distances of curved cores that GJK does not settle and
//          for all their depths.
#include <algorithm>
#include <limits>
#include <vector>

#include "algorithms/kernels/batch/for_each_pair.h"
#include "algorithms/kernels/gjk/gjk_distance.h"
#include "algorithms/kernels/gjk/gjk_iteration.h"
#include "algorithms/kernels/minkowski/support.h"
#include "algorithms/narrow_phase.h"
#include "algorithms/narrow_phase/certified/distance_bounds.h"
#include "algorithms/narrow_phase/certified/double_bounds.h"
#include "algorithms/narrow_phase/certified/halfspace_bounds.h"
#include "algorithms/narrow_phase/certified/level_contact.h"
#include "algorithms/narrow_phase/certified/placed_body.h"
#include "algorithms/narrow_phase/certified/polytope_contact.h"
#include "algorithms/narrow_phase/certified/proven_rounding.h"
#include "algorithms/oracle/answer.h"

namespace touchstone {
namespace {

using Pair = SupportPair<double>;

constexpr int most_iterations = 128;
constexpr double default_tolerance = 2e-13, least_tolerance = 4e-15;  // relative to the size
constexpr double least_digits = 1e-9;  // relative to the size: a wider enclosure is not a number

class Certified final : public NarrowPhase {
 public:
  explicit Certified(const NarrowPhaseSettings& settings)
      : tolerance_(std::max(settings.tolerance.value_or(default_tolerance), least_tolerance)) {}

  void bind(std::span<const Shape> shapes) override {
    shapes_.clear();
    shapes_.reserve(shapes.size());
    for (const Shape& shape : shapes) shapes_.emplace_back(shape);
    ahead_.bind(shapes_, &PreparedShape::support);
  }

  void solve(Task task, const PairBatch& batch, std::span<Outcome> outcomes) override {
    for_each_pair(batch.pairs, shapes_, ahead_, asks_distance(task),
                  [&](std::size_t i, const PreparedShape& a, const Pose& pose_a,
                      const PreparedShape& b, const Pose& pose_b) {
                    solve_pair({{a, pose_a}, {b, pose_b}, tolerance_}, task, batch, outcomes[i]);
                  });
  }

 private:
  // A call of it costs pairs far apart 4 % of their instructions.
  [[gnu::always_inline]] inline void solve_pair(const PlacedPair& bodies, Task task,
                                                const PairBatch& batch, Outcome& outcome);
  bool filter(const PlacedPair& bodies, Task task, Outcome& outcome);
  bool fast_gjk_decides(Pair& pair, const PlacedPair& bodies, Outcome& outcome);
  bool gjk_distance_decides(Pair& pair, const PlacedPair& bodies, Task task, Outcome& outcome);
  bool on_plane(const PlacedPair& bodies, Task task, Outcome& outcome);

  double tolerance_;
  std::vector<PreparedShape> shapes_;
  ShapePrefetch<double> ahead_;
  DistanceBounder gaps_;
  PolytopeContact contacts_;
  HalfspaceBounder heights_;
  oracle::Oracle oracle_;
};

void Certified::solve_pair(const PlacedPair& bodies, Task task, const PairBatch& batch,
                           Outcome& outcome) {
  outcome.iterations = outcome.support_calls = 0;
  const bool decided = batch.kind_a == ShapeKind::halfspace   ? false
                       : batch.kind_b == ShapeKind::halfspace ? on_plane(bodies, task, outcome)
                                                              : filter(bodies, task, outcome);
  if (decided) return;
  const PlacedBody &a = bodies.a, &b = bodies.b;
  outcome.support_calls = -1;
  oracle::answer(oracle_, {a.shape.solid, a.pose}, {b.shape.solid, b.pose}, task, outcome);
  // The enclosure of round cores deep in each other may be wide: then it is a bound, not a depth.
  const bool curved = a.shape.solid.is_curved() || b.shape.solid.is_curved();
  if (asks_depth(task) && outcome.answer != Answer::separated && curved &&
      outcome.upper - outcome.lower > least_digits * bodies.size()) {
    outcome.status = Status::not_converged;
  }
}

bool Certified::filter(const PlacedPair& bodies, Task task, Outcome& outcome) {
  const PlacedBody &a = bodies.a, &b = bodies.b;
  if (!asks_distance(task) &&
      balls_are_apart(a.shape.support(), a.pose, b.shape.support(), b.pose)) {
    return write_verdict(Answer::separated, outcome);
  }
  const Shape &shape_a = *a.shape.proven.shape, &shape_b = *b.shape.proven.shape;
  if (shape_a.kind == ShapeKind::box && shape_b.kind == ShapeKind::box &&
      may_be_level(a.pose.rotation) &&
      decide_level_boxes(shape_a, a.pose, shape_b, b.pose, task, outcome)) {
    return true;
  }
  Pair pair(a.shape.support(), a.pose, b.shape.support(), b.pose);
  const bool decided =
      is_in_range(pair) && ((task == Task::intersect && fast_gjk_decides(pair, bodies, outcome)) ||
                            gjk_distance_decides(pair, bodies, task, outcome));
  outcome.support_calls = pair.support_calls();
  return decided;
}

// Returns true if a point of the difference is certainly nearer to the origin than the radii.
bool is_within_radius(const Pair& pair, const Simplex<double>& simplex) {
  return pair.radius() > proven_rounding &&
         distance_from_origin(simplex) + proven_rounding < pair.radius();
}

// Tries the verdict of GJK's fast iteration.
bool Certified::fast_gjk_decides(Pair& pair, const PlacedPair& bodies, Outcome& outcome) {
  FastGjkResult<double> found =
      fast_gjk(pair, {.only_apart = true, .most_iterations = most_iterations}, 0.0);
  outcome.iterations = found.iterations;
  switch (found.end) {
    case FastGjkEnd::apart:
      return found.lower > pair.radius() + proven_rounding &&
             write_verdict(Answer::separated, outcome);
    case FastGjkEnd::inside: return write_verdict(Answer::overlapping, outcome);
    default: break;
  }
  if (pair.radius() == 0 && bodies.has_polytopes()) {
    return contacts_.decide_exactly(pair, found.simplex, -found.direction, bodies, Task::intersect,
                                    outcome);
  }
  if (found.simplex.size == 0) return false;
  const NearestPoint<double> nearest = reduce_to_nearest(found.simplex);
  return !nearest.inside && is_within_radius(pair, found.simplex) &&
         write_verdict(Answer::overlapping, outcome);
}

// Runs GJK's distance loop and tests what its end proves.
bool Certified::gjk_distance_decides(Pair& pair, const PlacedPair& bodies, Task task,
                                     Outcome& outcome) {
  const GjkDistanceGoal<double> goal{
      .task = asks_depth(task) ? task : Task::distance,
      .tolerance = std::max(4 * std::numeric_limits<double>::epsilon(),
                            tolerance_in_doubles(pair, bodies.widest())),
      .most_iterations = most_iterations};
  const GjkDistanceResult<double> found = gjk_distance(pair, goal);
  outcome.iterations += found.iterations;
  const Simplex<double>& simplex = found.simplex;
  const bool polytopes = bodies.has_polytopes();
  const bool rounded = pair.radius() > 0;
  // GJK gives twice the rounding as the depth in a tetrahedron that surely encloses the origin.
  const double near = found.nearest.inside ? 1.5 * Pair::rounding : PolytopeContact::nearly;
  const bool at_contact = polytopes && !rounded && found.nearest.distance <= near;
  const auto contact_decides = [&] {
    const Vec3d direction = found.nearest.inside ? found.direction : -found.nearest.direction;
    return contacts_.decide_exactly(pair, simplex, direction, bodies, task, outcome);
  };
  if (found.nearest.inside) {
    // At contact no tetrahedron is surely around the origin.
    if (!asks_depth(task) && !at_contact && simplex.size == 4 && is_surely_inside(simplex)) {
      return write_verdict(Answer::overlapping, outcome);
    }
    if (at_contact && contact_decides()) return true;
    if (!polytopes || rounded) return false;
    return asks_depth(task) ? contacts_.find_depth(pair, simplex, bodies, gaps_, task, outcome)
                            : contacts_.encloses(pair, simplex, outcome);
  }
  if (task == Task::penetration && found.lower > pair.radius() + proven_rounding) {
    return write_verdict(Answer::separated, outcome);
  }
  if (!asks_depth(task) && is_within_radius(pair, simplex)) {
    return write_verdict(Answer::overlapping, outcome);
  }
  if (at_contact &&
      (contact_decides() ||
       (asks_depth(task) && contacts_.find_depth(pair, simplex, bodies, gaps_, task, outcome)))) {
    return true;
  }
  const Vec3d normal = -found.nearest.direction;
  if (!write_bounds(between_in_doubles(pair, found), bodies.widest(), task, outcome)) {
    const PlacedBody &a = bodies.a, &b = bodies.b;
    const DistanceBounds gap =
        gaps_.between(a.shape.proven, a.pose, b.shape.proven, b.pose, pair, simplex, normal);
    if (!write_bounds(gap, bodies.widest(), task, outcome) &&
        !(polytopes && rounded &&
          contacts_.decide_rounded(pair, simplex, normal, gap, bodies, task, outcome))) {
      return false;
    }
  }
  if (asks_for_number(task, outcome.answer)) {
    const DifferencePoint<double> nearest = weighted_mean(simplex);
    outcome.normal = normal;
    outcome.witness_a = pair.to_world(nearest.a + pair.radius_a() * normal);
    outcome.witness_b = pair.to_world(nearest.b - pair.radius_b() * normal);
  }
  return true;
}

// Solves a pair whose body b is a half-space.
bool Certified::on_plane(const PlacedPair& bodies, Task task, Outcome& outcome) {
  const PlacedBody &a = bodies.a, &b = bodies.b;
  outcome.support_calls = 1;
  const Shape &shape_a = *a.shape.proven.shape, &shape_b = *b.shape.proven.shape;
  if (shape_a.kind == ShapeKind::box && may_be_level(a.pose.rotation) &&
      decide_level_plane(shape_a, a.pose, shape_b, b.pose, task, outcome)) {
    return true;
  }
  const double widest = bodies.tolerance * a.shape.size();
  Vec3d outward = Vec3d::Zero();
  const bool is_clear = write_bounds(
      HalfspaceBounder::roughly(a.shape.proven, a.pose, b.shape.proven, b.pose, outward), widest,
      task, outcome);
  if (is_clear && task == Task::intersect) return true;
  const SupportShape<double>& shape = a.shape.support();
  const double unit = power_of_two_above(shape.reach(a.pose.rotation));
  if (!is_clear) {
    const DistanceBounds gap =
        heights_.closely(a.shape.proven, a.pose, b.shape.proven, b.pose, outward);
    if (!write_bounds(gap, widest, task, outcome) &&
        !contacts_.decide_over_plane(gap, unit, bodies, task, outcome)) {
      return false;
    }
  }
  if (asks_for_number(task, outcome.answer)) {
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
           .tasks = {all_tasks.begin(), all_tasks.end()},
           .scalars = {Precision::float64},
           .tolerance =
               "the gap between both proven bounds on a distance or depth, as a part of the "
               "greater body; 2e-13",
           .make = [](const NarrowPhaseSettings& settings) {
             return std::make_unique<Certified>(settings);
           }}};
}

}  // namespace touchstone::entries
