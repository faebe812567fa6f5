// Exact cast: the time of impact of polytopes that move without turning, in integers.
// Paper:   see ../README.md for the problem. The search is conservative advancement in exact arithmetic,
//          between the difference of the cores and the point that moves past it.
// Steps:   1. Place both bodies on one grid of integers; time runs from 0 to 2^80 (moving_cores).
//          2. GJK in integers finds the point z of the difference that is nearest at the time: its norm
//             falls with every step, so it ends (nearest).
//          3. If |z| <= R, the sum of the radii, the bodies are in contact.
//          4. Otherwise z is the normal of a plane that parts them. The gap along it is linear in time: go
//             to the last time at which it exceeds R, by integers alone. If that is the end, it is a miss.
//          5. Where the plane gains nothing, the next time is tried by itself; if there is contact,
//             both are the bracket. If neither shows whether there was any between them, as where corners pass each
//             other, the one time decides at which the bodies are nearest on the line of the path: GJK in
//             integers finds it, seen along the path.
//          6. Bodies that turn, cylinders, cones, ellipsoids and half-spaces get an enclosure instead:
//             conservative advancement with the exact distance of poses that are rounded to double, less what
//             that can change (enclosure). Contact at the start is decided for the poses that are given.
//          7. Where contact at the start counts only if the bodies approach, the depth of b in what a covers on its
//             way past b decides of those that begin within the tolerance (exact_approach).
//          prove_cast makes a certificate of each answer, which another program verifies.
// Departs: nothing is rounded but the results: `lower` down and `upper` up to doubles. A miss and a hit
//          are exact; the bracket is 2^-80 wide before it is rounded. `toi` is its upper end, rounded. An
//          enclosure narrows until the path in the bracket is about the tolerance, 1e-9 of the size.
// Fails:   unknown / not_converged after 4,000 times, or 20,000 of an enclosure, if no other cap is asked for;
//          GJK at one time has none. An enclosure is unknown where the bodies come within
//          1e-15 of the path without a proof of either, and where curved cores are that deep in each
//          other. Half-spaces do not turn. Whether turning bodies approach is unsupported.
// Cost:    about a tenth of a millisecond for boxes, some for hulls; an enclosure some tens; allocates.
#include <optional>
#include <vector>

#include "algorithms/cast.h"
#include "algorithms/oracle/cast/enclosure.h"
#include "algorithms/oracle/cast/exact_approach.h"
#include "algorithms/oracle/cast/linear_search.h"
#include "algorithms/oracle/cast/prove_cast.h"
#include "algorithms/oracle/numbers/dyadic.h"

namespace touchstone {
namespace {

using oracle::Body;
using oracle::IntegerVector;

bool is_polytope(ShapeKind kind) {
  return kind == ShapeKind::sphere || kind == ShapeKind::capsule || kind == ShapeKind::box ||
         kind == ShapeKind::hull;
}

class ExactCast final : public Cast {
 public:
  explicit ExactCast(const CastSettings& settings)
      : tolerance_(settings.tolerance), cap_(settings.max_iterations), start_(settings.start) {}

  void bind(std::span<const Shape> shapes) override {
    solids_.clear();
    solids_.reserve(shapes.size());
    for (const Shape& shape : shapes) solids_.emplace_back(shape);
    shapes_ = shapes;
  }

  void solve(const CastBatch& batch, std::span<CastOutcome> outcomes) override {
    const BodyPairs& pairs = batch.pairs;
    for (std::size_t i = 0; i < batch.size(); ++i) {
      const std::uint32_t a = pairs.first[i], b = pairs.second[i];
      outcomes[i] = {};
      const bool turns = batch.motions[a].turns() || batch.motions[b].turns();
      const bool asks_approach = start_ == StartContact::approach;
      if ((batch.kind_b == ShapeKind::halfspace && batch.motions[b].turns()) ||
          (turns && asks_approach)) {
        outcomes[i].status = Status::unsupported;
        continue;
      }
      const auto body = [&](std::uint32_t k) {
        const std::uint32_t shape = pairs.shape_of[k];
        return oracle::enclosed(shapes_[shape], solids_[shape], pairs.poses[k], batch.motions[k]);
      };
      const oracle::EnclosedBody body_a = body(a), body_b = body(b);
      const double tolerance = tolerance_.value_or(oracle::default_tolerance(body_a, body_b));
      const Body placed_a(*body_a.solid, *body_a.pose), placed_b(*body_b.solid, *body_b.pose);
      if (is_polytope(batch.kind_a) && is_polytope(batch.kind_b) && !turns) {
        cast(placed_a, *body_a.motion, placed_b, *body_b.motion, outcomes[i]);
      } else {
        oracle::EnclosureGoal goal{tolerance};
        if (cap_) goal.most_steps = *cap_;
        oracle::enclose(oracle_, body_a, body_b, goal, outcomes[i]);
      }
      if (asks_approach && oracle_.measure(placed_a, placed_b).lower <= tolerance) {
        weigh_start(oracle::approach(oracle_, placed_a, *body_a.motion, placed_b, *body_b.motion,
                                     tolerance),
                    outcomes[i]);
      }
    }
  }

 private:
  // Changes the outcome of bodies that are within the tolerance of each other at the start.
  static void weigh_start(oracle::Approach approach, CastOutcome& outcome) {
    const std::int32_t iterations = outcome.iterations;
    switch (approach) {
      case oracle::Approach::no:
        outcome = {.answer = CastAnswer::miss, .status = Status::ok, .iterations = iterations};
        return;
      case oracle::Approach::unknown:
        outcome = {.status = Status::not_converged, .lower = 0, .iterations = iterations};
        return;
      case oracle::Approach::yes: return;
    }
  }

  void cast(const Body& a, const Motion& motion_a, const Body& b, const Motion& motion_b,
            CastOutcome& outcome) const;

  std::optional<double> tolerance_;
  std::optional<int> cap_;
  StartContact start_;
  std::vector<oracle::Solid> solids_;
  std::span<const Shape> shapes_;
  oracle::Oracle oracle_;
};

// The unit vector from a to b: against z, which is a point of a - b.
Vec3d normal_of(const IntegerVector& z) {
  Vec3d normal;
  long greatest = std::numeric_limits<long>::min();
  for (int k = 0; k < 3; ++k) {
    if (!z[k].is_zero()) greatest = std::max(greatest, oracle::scaled(z[k]).exponent);
  }
  for (int k = 0; k < 3; ++k) {
    const oracle::Scaled part = oracle::scaled(z[k]);
    normal[k] = z[k].is_zero()
                    ? 0.0
                    : -std::ldexp(part.mantissa,
                                  static_cast<int>(std::max(part.exponent - greatest, -2000L)));
  }
  return normal.normalized();
}

// A point of both bodies at the contact, up to rounding.
Vec3d point_of(const oracle::LinearContact& contact, const Body& a, const Motion& motion_a,
               const Body& b, const Motion& motion_b, double time) {
  const auto& [steps, parts, feature, weights] = contact;
  oracle::Integer sum = 0;
  for (const oracle::Integer& weight : weights) sum += weight;
  const oracle::Scaled whole = oracle::scaled(sum);
  const auto placed = [&](const Body& body, const Motion& motion, std::uint32_t vertex) -> Vec3d {
    return body.matrix * body.solid->vertices[vertex] + body.translation +
           time * motion.displacement;
  };
  Vec3d on_a = Vec3d::Zero(), on_b = Vec3d::Zero();
  for (std::size_t i = 0; i < feature.size(); ++i) {
    const oracle::Scaled part = oracle::scaled(weights[i]);
    const double weight = std::ldexp(part.mantissa / whole.mantissa,
                                     static_cast<int>(part.exponent - whole.exponent));
    on_a += weight * placed(a, motion_a, feature[i].a);
    on_b += weight * placed(b, motion_b, feature[i].b);
  }
  const double radii = a.solid->radius + b.solid->radius;
  return radii > 0 ? Vec3d(on_a + a.solid->radius / radii * (on_b - on_a)) : on_a;
}

void ExactCast::cast(const Body& a, const Motion& motion_a, const Body& b, const Motion& motion_b,
                     CastOutcome& outcome) const {
  constexpr long exponent = -oracle::MovingCores::time_bits;
  const oracle::MovingCores cores(a, motion_a, b, motion_b);
  outcome.iterations = 0;
  outcome.status = Status::ok;
  oracle::LinearSearch search(cores, outcome.iterations);
  const oracle::LinearImpact impact =
      cap_ ? oracle::find_impact(search, *cap_) : oracle::find_impact(search);
  outcome.answer = impact.answer;
  if (impact.answer == CastAnswer::miss) return;
  if (impact.answer == CastAnswer::unknown) {
    outcome.status = Status::not_converged;
    outcome.lower = 0;
    return;
  }
  outcome.lower = oracle::round_down(impact.lower, exponent);
  // The least number of 2^-64 of a step that is not below.
  constexpr long finer = 64;
  const oracle::Integer& parts = impact.contact.parts;
  const oracle::Integer upper = ((impact.contact.steps << finer) + parts - 1) / parts;
  outcome.toi = outcome.upper = oracle::round_up(upper, exponent - finer);
  if (impact.plane) outcome.normal = normal_of(*impact.plane);
  outcome.point = point_of(impact.contact, a, motion_a, b, motion_b, outcome.toi);
}

// Of two half-spaces none may turn, and of a body and a half-space only the body.
bool supports_exact(ShapeKind kind_a, ShapeKind, bool turns) {
  return !turns || kind_a != ShapeKind::halfspace;
}

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<CastEntry> oracle_exact_cast() {
  return {
      {.info = {.name = "exact",
                .citation = "Touchstone's oracle: conservative advancement of polytopes and balls "
                            "around them in integers; an enclosure of others and of turning ones",
                .origin = Origin::oracle},
       .scalars = {Precision::float64},
       .rotation = true,
       .approach = true,
       .in_time = true,
       .supports = supports_exact,
       .make = [](const CastSettings& settings) { return std::make_unique<ExactCast>(settings); }}};
}

}  // namespace touchstone::entries
