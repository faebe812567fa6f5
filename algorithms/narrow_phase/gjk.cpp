// GJK: walk on the difference A - B towards the origin, one support point at a time; EPA for depth.
// Paper:   Gilbert, Johnson, Keerthi, IEEE J. Robotics and Automation 4(2), 1988; sub-distance of
//          Montanari, Petrinic, Barbieri, ACM TOG 36(3), 2017; depth: van den Bergen, GDC 2001.
// Departs: stops by the duality gap: the simplex bounds the distance from above, each support plane
//          from below; relative to the size, or by NarrowPhaseSettings::duality_gap the absolute
//          gap of the squared distance that Montaut et al. stop by. Round shapes are cores with a
//          radius, so that shallow overlaps of theirs need no EPA. Where the origin is on the
//          simplex, EPA decides: a verdict is `ok` only where a bound proves it beyond rounding.
//          Never answers `touching`. The loop is in gjk_approach.h, with a quick walk before it.
//          Bodies whose balls are apart are not walked between, but for their distance.
//          With a PairMemory it starts warm (kernels/warm_start.h): from the last tetrahedron, the
//          last separating plane, or the last simplex; EPA does not. gjk-nesterov starts cold.
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
#include <cstring>
#include <limits>
#include <type_traits>

#include "algorithms/kernels/expanding_polytope.h"
#include "algorithms/kernels/gjk_approach.h"
#include "algorithms/kernels/halfspace.h"
#include "algorithms/narrow_phase.h"

namespace touchstone {
namespace {

constexpr int default_gjk_cap = 128;
constexpr int default_epa_cap = 256;

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
        const bool warm = momentum_ == Momentum::none && !batch.memory.empty();
        solve_pair(pair, batch.task, warm ? &batch.memory[batch.memory_of[i]] : nullptr,
                   outcomes[i]);
      }
    }
  }

 private:
  static constexpr Scalar rounding = SupportPair<Scalar>::rounding;

  void solve_pair(SupportPair<Scalar>& pair, Task task, PairMemory* memory, Outcome& outcome);
  Approach<Scalar> approach_from(SupportPair<Scalar>& pair, const ApproachGoal<Scalar>& goal,
                                 PairMemory* memory);
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

// From what is in memory, where there is some; and leaves there what was found.
template <class Scalar>
Approach<Scalar> Gjk<Scalar>::approach_from(SupportPair<Scalar>& pair,
                                            const ApproachGoal<Scalar>& goal, PairMemory* memory) {
  if (memory == nullptr) return approach(pair, goal);
  static_assert(sizeof(WarmStart) <= sizeof(PairMemory) && std::is_trivially_copyable_v<WarmStart>);
  WarmStart start;
  std::memcpy(&start, memory->bytes.data(), sizeof start);
  const Approach<Scalar> found = approach(pair, goal, &start);
  if (!found.as_before) {
    start.keep(pair, found.simplex, found.direction);
    std::memcpy(memory->bytes.data(), &start, sizeof start);
  }
  return found;
}

template <class Scalar>
void Gjk<Scalar>::solve_pair(SupportPair<Scalar>& pair, Task task, PairMemory* memory,
                             Outcome& outcome) {
  using End = typename Approach<Scalar>::End;
  const Scalar tolerance = tolerance_for(pair);
  const ApproachGoal<Scalar> goal{.task = task,
                                  .tolerance = tolerance,
                                  .duality_gap = duality_gap_,
                                  .most_iterations = gjk_cap_,
                                  .momentum = momentum_};
  const Approach<Scalar> found = approach_from(pair, goal, memory);
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
                       (!asked || !goal.is_open(pair, found.nearest.distance, found.lower));
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

NarrowPhaseEntry entry(AlgorithmInfo info, bool starts_warm,
                       std::unique_ptr<NarrowPhase> (*make)(const NarrowPhaseSettings&)) {
  return {.info = std::move(info),
          .tasks = {Task::intersect, Task::distance, Task::penetration},
          .scalars = {Precision::float32, Precision::float64},
          .stops_by_duality_gap = true,
          .starts_warm = starts_warm,
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
                true, make<Momentum::none>),
          entry({.name = "gjk-nesterov",
                 .citation = "Montaut, Le Lidec, Petrik, Sivic, Carpentier, \"Collision detection "
                             "accelerated: an optimization perspective\", RSS 2022" +
                             depth},
                false, make<Momentum::nesterov>)};
}
