// GJK: walk on the difference A - B towards the origin, one support point at a time; EPA for depth.
// Paper:   Gilbert, Johnson, Keerthi, IEEE J. Robotics and Automation 4(2), 1988; sub-distance of
//          Montanari, Petrinic, Barbieri, ACM TOG 36(3), 2017; depth: van den Bergen, GDC 2001.
// Departs: stops by the duality gap: the simplex bounds the distance from above, each support plane
//          from below; relative to the size, or by NarrowPhaseSettings::duality_gap the absolute
//          gap of the squared distance that Montaut et al. stop by. Round shapes are cores with a
//          radius, so that shallow overlaps of theirs need no EPA. Where the origin is on the
//          simplex, EPA decides: a verdict is `ok` only where a bound proves it beyond rounding.
//          Never answers `touching`. A quick walk with plain products comes first (simplex_walk.h);
//          this one makes its end good, or goes on from there. Bodies whose balls are apart are not
//          walked between, but for their distance.
// Fails:   unknown / not_converged within 1e-14 (double) or 5e-6 (float) of touching, as a part of
//          the pair's size. Depth of smooth, nearly round bodies far inside each other: EPA's cap
//          comes first, not_converged with bounds.
//          gjk-nesterov looks along a direction with momentum (Montaut, Le Lidec, Petrik, Sivic,
//          Carpentier, "Collision detection accelerated: an optimization perspective", RSS 2022,
//          algorithm 3; its normalised form where a core has corners) until that brings nothing
//          new, and is plain GJK from there on.
// Cost:    O(1) space; a few support calls for each digit on smooth shapes, finite on polytopes.
//          Caps: 128 iterations of GJK, 256 of EPA. Tolerance, as a part of the size: 1e-10
//          (double) or 1e-5 (float); polytopes go on until nothing is left but rounding.
#include <algorithm>
#include <cmath>
#include <limits>

#include "algorithms/kernels/expanding_polytope.h"
#include "algorithms/kernels/halfspace.h"
#include "algorithms/kernels/nesterov_direction.h"
#include "algorithms/kernels/simplex.h"
#include "algorithms/kernels/simplex_walk.h"
#include "algorithms/kernels/support.h"
#include "algorithms/narrow_phase.h"

namespace touchstone {
namespace {

constexpr int default_gjk_cap = 128;
constexpr int default_epa_cap = 256;

// What GJK knows of the distance between the cores, in the pair's unit.
template <class Scalar>
struct Approach {
  enum class End {
    decided,    // as far as the task needs
    contact,    // the origin is inside the simplex, or on it up to rounding
    no_better,  // rounding
    cap,
  };
  End end = End::cap;
  Simplex<Scalar> simplex;
  NearestPoint<Scalar> nearest;
  Scalar lower = 0;
  Scalar upper = std::numeric_limits<Scalar>::infinity();
  int iterations = 0;
};

// Where to look for the next support point.
enum class Momentum : std::uint8_t { none, nesterov };

template <class Scalar>
class Gjk final : public NarrowPhase {
 public:
  Gjk(const NarrowPhaseSettings& settings, Momentum momentum)
      : momentum_(momentum),
        tolerance_(settings.tolerance),
        duality_gap_(settings.duality_gap),
        gjk_cap_(std::max(1, settings.max_iterations.value_or(default_gjk_cap))),
        polytope_(std::max(1, settings.max_iterations.value_or(default_epa_cap))) {}

  void bind(std::span<const Shape> shapes) override {
    shapes_ = make_support_shapes<Scalar>(shapes);
  }

  void solve(const PairBatch& batch, std::span<Outcome> outcomes) override {
    for (std::size_t i = 0; i < batch.size(); ++i) {
      const std::uint32_t a = batch.first[i];
      const std::uint32_t b = batch.second[i];
      const SupportShape<Scalar>& shape_a = shapes_[batch.shape_of[a]];
      const SupportShape<Scalar>& shape_b = shapes_[batch.shape_of[b]];
      if (batch.kind_a == ShapeKind::halfspace) {
        solve_halfspaces(shape_a, batch.poses[a], shape_b, batch.poses[b], batch.task, outcomes[i]);
      } else if (batch.kind_b == ShapeKind::halfspace) {
        solve_halfspace(shape_a, batch.poses[a], shape_b, batch.poses[b], batch.task, outcomes[i]);
      } else if (batch.task != Task::distance &&
                 balls_are_apart(shape_a, batch.poses[a], shape_b, batch.poses[b])) {
        outcomes[i].answer = Answer::separated;
        outcomes[i].status = Status::ok;
        outcomes[i].iterations = outcomes[i].support_calls = 0;
      } else {
        SupportPair<Scalar> pair(shape_a, batch.poses[a], shape_b, batch.poses[b]);
        solve_pair(pair, batch.task, outcomes[i]);
      }
    }
  }

 private:
  static constexpr Scalar rounding = SupportPair<Scalar>::rounding;

  void solve_pair(SupportPair<Scalar>& pair, Task task, Outcome& outcome);
  Approach<Scalar> approach(SupportPair<Scalar>& pair, Task task, Scalar tolerance) const;
  bool walk_first(SupportPair<Scalar>& pair, Task task, Scalar tolerance,
                  Approach<Scalar>& found) const;
  // Whether a lower bound is too far below the nearest point's distance to stop, both of the cores.
  bool is_open(const SupportPair<Scalar>& pair, Scalar nearest, Scalar lower,
               Scalar tolerance) const {
    const Scalar difference = nearest - lower;
    if (!duality_gap_) return difference > tolerance;
    const double area = pair.unit() * pair.unit();
    return difference > rounding &&
           2 * area * static_cast<double>(nearest * difference) > *duality_gap_;
  }
  void solve_contact(SupportPair<Scalar>& pair, const Approach<Scalar>& found, Task task,
                     Scalar tolerance, Outcome& outcome);
  Scalar tolerance_for(const SupportPair<Scalar>& pair) const {
    const double smooth = sizeof(Scalar) == 8 ? 1e-10 : 1e-5;
    const double own = pair.is_polytope() ? 0 : smooth;
    // The pair's unit is up to twice its size.
    return std::max(static_cast<Scalar>(tolerance_.value_or(own) / 2), rounding);
  }

  Momentum momentum_;
  std::optional<double> tolerance_, duality_gap_;
  int gjk_cap_;
  ExpandingPolytope<Scalar> polytope_;
  std::vector<SupportShape<Scalar>> shapes_;
};

// Writes a distance between the bodies, all in the pair's unit: `distance` and its bounds signed;
// `normal` from a to b; `a` and `b` witness points of the cores.
template <class Scalar>
void write(const SupportPair<Scalar>& pair, Scalar distance, Scalar lower, Scalar upper,
           const Vec3<Scalar>& normal, const Vec3<Scalar>& a, const Vec3<Scalar>& b,
           Outcome& outcome) {
  constexpr double rounding = static_cast<double>(SupportPair<Scalar>::rounding);
  outcome.distance = pair.unit() * static_cast<double>(distance);
  outcome.lower = pair.unit() * (static_cast<double>(lower) - rounding);
  outcome.upper = pair.unit() * (static_cast<double>(upper) + rounding);
  outcome.normal = normal.template cast<double>();
  outcome.witness_a = pair.to_world(a + pair.radius_a() * normal);
  outcome.witness_b = pair.to_world(b - pair.radius_b() * normal);
}

// Whether the quick walk is all that was needed; if not, how far it came.
template <class Scalar>
bool Gjk<Scalar>::walk_first(SupportPair<Scalar>& pair, Task task, Scalar tolerance,
                             Approach<Scalar>& found) const {
  using End = typename Approach<Scalar>::End;
  const Walk<Scalar> quick =
      walk(pair, {.only_apart = task != Task::distance, .most_iterations = gjk_cap_}, tolerance);
  found.iterations = quick.iterations;
  found.simplex = quick.simplex;
  if (quick.end == WalkEnd::apart) {
    found.lower = quick.lower;
    found.end = End::decided;
    return true;
  }
  found.upper = 0;
  found.end = End::contact;
  if (quick.end == WalkEnd::inside) {
    found.nearest.inside = true;
    found.nearest.distance = 2 * rounding;  // at least
    return true;
  }
  if (found.simplex.size == 0) return false;
  found.nearest = reduce_to_nearest(found.simplex);
  if (found.nearest.inside || !(found.nearest.distance > rounding)) return true;
  found.upper = found.nearest.distance;
  found.end = End::cap;
  if (quick.end != WalkEnd::near || is_open(pair, found.nearest.distance, quick.lower, tolerance)) {
    return false;
  }
  found.lower = quick.lower;
  found.end = End::decided;
  return true;
}

template <class Scalar>
Approach<Scalar> Gjk<Scalar>::approach(SupportPair<Scalar>& pair, Task task,
                                       Scalar tolerance) const {
  using End = typename Approach<Scalar>::End;
  // Steps that do not come nearer may still turn the plane; but not for ever.
  constexpr int patience = 8;
  const Scalar radius = pair.radius();
  Approach<Scalar> found;
  found.lower = -std::numeric_limits<Scalar>::infinity();
  Simplex<Scalar>& simplex = found.simplex;

  const Scalar length = pair.centre_b().norm();
  Vec3<Scalar> direction =
      length > 0 ? Vec3<Scalar>(pair.centre_b() / length) : Vec3<Scalar>::UnitX();
  if (momentum_ == Momentum::none && !duality_gap_) {
    if (walk_first(pair, task, tolerance, found)) return found;
    if (simplex.size > 0) direction = -found.nearest.direction;
  }
  int stalled = 0;
  bool accelerated = momentum_ == Momentum::nesterov;
  NesterovDirection<Scalar> nesterov(pair.is_polytope(), -pair.centre_b());
  while (found.iterations < gjk_cap_) {
    ++found.iterations;
    const DifferencePoint<Scalar> point = pair.support(direction);
    const Scalar lower = -direction.dot(point.difference);
    const bool of_normal = task == Task::penetration && !accelerated;
    found.lower = of_normal ? lower : std::max(found.lower, lower);
    const bool apart = found.lower - radius > rounding;
    // Comparisons are written so that NaN ends the loop.
    const bool open =
        is_open(pair, found.nearest.distance, found.lower, tolerance) || simplex.size == 0;
    switch (task) {
      case Task::intersect:
        if (apart) found.end = End::decided;
        break;
      case Task::distance:
        if (apart && !open) found.end = End::decided;
        break;
      case Task::penetration:
        if (apart || (!open && found.lower > rounding)) found.end = End::decided;
        break;
    }
    bool known = false;
    for (int i = 0; i < simplex.size; ++i) {
      known = known || simplex.points[i].difference == point.difference;
    }
    // The paper's stop: the support point is no nearer to the origin along the nearest point.
    const bool spent = accelerated && simplex.size > 0 &&
                       !is_open(pair, found.nearest.distance,
                                found.nearest.direction.dot(point.difference), tolerance);
    // A shallow overlap of round shapes: the bound is to hold along the normal that is reported.
    const bool oblique = accelerated && task == Task::penetration && !apart && !open;
    if (accelerated && (found.end != End::decided || oblique) && (known || spent || oblique)) {
      accelerated = false;
      found.end = End::cap;
      direction = -found.nearest.direction;
      continue;
    }
    if (found.end == End::decided) return found;
    if (known) {
      found.end = End::no_better;
      return found;
    }

    simplex.points[simplex.size++] = point;
    found.nearest = reduce_to_nearest(simplex);
    if (found.nearest.inside || !(found.nearest.distance > rounding)) {
      found.upper = 0;
      found.end = End::contact;
      return found;
    }
    if (!(found.nearest.distance < found.upper) && ++stalled > patience) {
      found.end = End::no_better;
      return found;
    }
    found.upper = std::min(found.upper, found.nearest.distance);
    if (task != Task::penetration && found.upper - radius < -rounding) {
      found.end = End::decided;
      return found;
    }
    direction = -found.nearest.direction;
    if (accelerated) {
      const Vec3<Scalar> nearest = found.nearest.distance * found.nearest.direction;
      const Vec3<Scalar> ahead = nesterov.next(nearest, point.difference);
      if (ahead.squaredNorm() > Scalar{0.5}) direction = ahead;
    }
  }
  return found;
}

template <class Scalar>
void Gjk<Scalar>::solve_pair(SupportPair<Scalar>& pair, Task task, Outcome& outcome) {
  using End = typename Approach<Scalar>::End;
  const Scalar tolerance = tolerance_for(pair);
  const Approach<Scalar> found = approach(pair, task, tolerance);
  outcome.iterations = found.iterations;
  if (found.end == End::contact) {
    solve_contact(pair, found, task, tolerance, outcome);
  } else {
    const Scalar lower = found.lower - pair.radius();
    const Scalar upper = found.upper - pair.radius();
    outcome.answer = lower > rounding    ? Answer::separated
                     : upper < -rounding ? Answer::overlapping
                                         : Answer::unknown;
    const bool asked = (task == Task::distance && outcome.answer != Answer::overlapping) ||
                       (task == Task::penetration && outcome.answer != Answer::separated);
    // A bound that the answer did not need may be open.
    const bool known = outcome.answer != Answer::unknown &&
                       (!asked || !is_open(pair, found.nearest.distance, found.lower, tolerance));
    outcome.status = known ? Status::ok : Status::not_converged;
    if (asked) {
      Vec3<Scalar> a = Vec3<Scalar>::Zero();
      Vec3<Scalar> b = Vec3<Scalar>::Zero();
      for (int i = 0; i < found.simplex.size; ++i) {
        a += found.simplex.weights[i] * found.simplex.points[i].a;
        b += found.simplex.weights[i] * found.simplex.points[i].b;
      }
      const Vec3<Scalar> normal = -found.nearest.direction;
      write(pair, found.nearest.distance - pair.radius(), lower, upper, normal, a, b, outcome);
    }
  }
  outcome.support_calls = pair.support_calls();
}

// How far the nearest point, as its weights have it, is from the origin.
template <class Scalar>
Scalar off_core(const Simplex<Scalar>& simplex) {
  Vec3<Scalar> sum = Vec3<Scalar>::Zero();
  for (int i = 0; i < simplex.size; ++i) sum += simplex.weights[i] * simplex.points[i].difference;
  return sum.norm();
}

// The cores share a point, up to rounding.
template <class Scalar>
void Gjk<Scalar>::solve_contact(SupportPair<Scalar>& pair, const Approach<Scalar>& found, Task task,
                                Scalar tolerance, Outcome& outcome) {
  const Scalar radius = pair.radius();
  const bool inside_core = found.nearest.inside && found.nearest.distance > rounding;
  const bool on_core = !found.nearest.inside && off_core(found.simplex) <= 4 * rounding;
  const bool proven = inside_core || (on_core && radius > 8 * rounding);
  if (proven && task != Task::penetration) {
    outcome.answer = Answer::overlapping;
    outcome.status = Status::ok;
    return;
  }
  ExpansionGoal<Scalar> goal{.tolerance = tolerance, .doubtful = !inside_core && !on_core};
  if (task != Task::penetration) goal.enough = rounding;
  const Expansion<Scalar> depth = polytope_.expand(pair, found.simplex, goal);
  outcome.iterations += depth.iterations;
  if (depth.end == ExpansionEnd::apart && -depth.upper - radius > rounding) {
    outcome.answer = Answer::separated;
    outcome.status = task == Task::distance ? Status::not_converged : Status::ok;
    return;
  }
  const bool inside =
      proven || depth.lower > rounding || (!goal.doubtful && depth.lower + radius > rounding);
  const bool known = depth.end == ExpansionEnd::converged || depth.end == ExpansionEnd::flat;
  outcome.answer = inside ? Answer::overlapping : Answer::unknown;
  outcome.status = Status::not_converged;
  if (inside && (known || task != Task::penetration)) outcome.status = Status::ok;
  if (!inside && depth.end == ExpansionEnd::flat) outcome.status = Status::degenerate;
  if (task == Task::intersect || (inside && task == Task::distance)) return;
  write(pair, -(radius + depth.upper), -(radius + depth.upper), -(radius + depth.lower),
        depth.normal, depth.a, depth.b, outcome);
}

template <Momentum momentum>
std::unique_ptr<NarrowPhase> make(const NarrowPhaseSettings& settings) {
  if (settings.scalar == Precision::float32) {
    return std::make_unique<Gjk<float>>(settings, momentum);
  }
  return std::make_unique<Gjk<double>>(settings, momentum);
}

NarrowPhaseEntry entry(AlgorithmInfo info,
                       std::unique_ptr<NarrowPhase> (*make)(const NarrowPhaseSettings&)) {
  return {.info = std::move(info),
          .tasks = {Task::intersect, Task::distance, Task::penetration},
          .scalars = {Precision::float32, Precision::float64},
          .stops_by_duality_gap = true,
          .make = make};
}

}  // namespace
}  // namespace touchstone

TOUCHSTONE_NARROW_PHASE {
  using namespace touchstone;
  const std::string depth =
      "; van den Bergen, \"Proximity queries and penetration depth computation on 3D game "
      "objects\", GDC 2001";
  return {entry({.name = "gjk",
                 .citation = "Gilbert, Johnson, Keerthi, \"A fast procedure for computing the "
                             "distance between complex objects in three-dimensional space\", IEEE "
                             "J. Robotics and Automation 4(2), 1988" +
                             depth},
                make<Momentum::none>),
          entry({.name = "gjk-nesterov",
                 .citation = "Montaut, Le Lidec, Petrik, Sivic, Carpentier, \"Collision detection "
                             "accelerated: an optimization perspective\", RSS 2022" +
                             depth},
                make<Momentum::nesterov>)};
}
