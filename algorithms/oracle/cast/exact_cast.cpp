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
//             both are the bracket.
//          6. Bodies that turn, cylinders, cones, ellipsoids and half-spaces get an enclosure instead:
//             conservative advancement with the exact distance of poses that are rounded to double, less what
//             that can change (enclosure).
// Departs: nothing is rounded but the results: `lower` down and `upper` up to doubles. A miss and a hit
//          are exact; the bracket is 2^-80 wide before it is rounded. `toi` is its upper end, rounded. An
//          enclosure narrows until the path in the bracket is about the tolerance, 1e-9 of the size.
// Fails:   unknown / not_converged where bodies touch for less than 2^-80 of the time, as corners may that
//          pass each other, or after 4,000 times. An enclosure is unknown where the bodies come within
//          1e-15 of the path without a proof of either, and where curved cores are that deep in each
//          other. Half-spaces do not turn.
// Cost:    about a tenth of a millisecond for boxes, some for hulls; an enclosure some tens; allocates.
#include <boost/multiprecision/integer.hpp>
#include <optional>
#include <vector>

#include "algorithms/cast.h"
#include "algorithms/core/bounds.h"
#include "algorithms/oracle/cast/enclosure.h"
#include "algorithms/oracle/cast/moving_cores.h"
#include "algorithms/oracle/cast/nearest.h"
#include "algorithms/oracle/numbers/dyadic.h"

namespace touchstone {
namespace {

using oracle::Body;
using oracle::dot;
using oracle::Integer;
using oracle::IntegerVector;
using oracle::operator*;  // of IntegerVector, which is an std::array
using oracle::operator-;
using oracle::RationalPoint;

// The difference of the cores at a time, seen from the point that moves past it.
class ExactSearch {
 public:
  ExactSearch(const oracle::MovingCores& cores, int& iterations)
      : cores_(cores), iterations_(iterations) {}

  const Integer& time() const { return time_; }
  const RationalPoint& nearest() const { return nearest_; }

  void go_to(const Integer& time) {
    const IntegerVector moved = (time - time_) * cores_.velocity();
    for (IntegerVector& point : simplex_) point = point - moved;
    time_ = time;
    find_nearest();
  }

  bool in_contact() const {
    const Integer reach = cores_.radius() * nearest_.denominator;
    return dot(nearest_.numerator, nearest_.numerator) <= reach * reach;
  }

  // True if the plane with the normal z parts the bodies `steps` of time later too, with |z| > R.
  bool is_free(const Integer& steps) const {
    const IntegerVector& z = nearest_.numerator;
    const Integer square = dot(z, z);
    const Integer gap = square - steps * dot(z, cores_.velocity()) * nearest_.denominator;
    const Integer reach = cores_.radius() * nearest_.denominator;
    return gap > 0 && gap * gap > reach * reach * square;
  }

  // A number of steps of time that the plane parts the bodies, one or two short of all; they close
  // along it.
  Integer steps() const {
    const IntegerVector& z = nearest_.numerator;
    const Integer square = dot(z, z);
    const Integer root = boost::multiprecision::sqrt(square) + 1;
    const Integer gap = square - cores_.radius() * nearest_.denominator * root;
    return gap / (dot(z, cores_.velocity()) * nearest_.denominator) - 1;
  }

  // True if there was no contact in the last step of time either. The distance is a convex function of
  // time: where it falls at the end of the step, or a plane parts the bodies at both ends, it is.
  bool was_free() const { return dot(nearest_.numerator, cores_.velocity()) >= 0 || is_free(-1); }

 private:
  void find_nearest() {
    if (simplex_.empty()) simplex_.push_back(point({1, 0, 0}));
    for (;;) {
      ++iterations_;
      nearest_ = oracle::reduce_to_nearest(simplex_);
      const IntegerVector& z = nearest_.numerator;
      if (oracle::is_zero(z)) return;
      const IntegerVector w = point(z);
      if (dot(z, w) * nearest_.denominator >= dot(z, z)) return;
      simplex_.push_back(w);
    }
  }
  IntegerVector point(const IntegerVector& n) const {
    return cores_.least(n) - time_ * cores_.velocity();
  }

  const oracle::MovingCores& cores_;
  int& iterations_;
  Integer time_ = 0;
  std::vector<IntegerVector> simplex_;
  RationalPoint nearest_;
};

bool is_polytope(ShapeKind kind) {
  return kind == ShapeKind::sphere || kind == ShapeKind::capsule || kind == ShapeKind::box ||
         kind == ShapeKind::hull;
}

class ExactCast final : public Cast {
 public:
  explicit ExactCast(const CastSettings& settings) : tolerance_(settings.tolerance) {}

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
      const bool exact = is_polytope(batch.kind_a) && is_polytope(batch.kind_b) &&
                         !batch.motions[a].turns() && !batch.motions[b].turns();
      if (!exact) {
        const auto body = [&](std::uint32_t k) -> oracle::EnclosedBody {
          const Shape& shape = shapes_[pairs.shape_of[k]];
          const double reach = loose_reach(shape, pairs.poses[k].rotation);
          // A half-space does not turn, and has no reach.
          return {&solids_[pairs.shape_of[k]], &pairs.poses[k], &batch.motions[k],
                  std::isfinite(reach) ? reach : 0};
        };
        const oracle::EnclosedBody body_a = body(a), body_b = body(b);
        const double size = std::max(body_a.reach, body_b.reach);
        oracle::enclose(oracle_, body_a, body_b, tolerance_.value_or(1e-9 * size), outcomes[i]);
        continue;
      }
      cast(Body(solids_[pairs.shape_of[a]], pairs.poses[a]), batch.motions[a],
           Body(solids_[pairs.shape_of[b]], pairs.poses[b]), batch.motions[b], outcomes[i]);
    }
  }

 private:
  static void cast(const Body& a, const Motion& motion_a, const Body& b, const Motion& motion_b,
                   CastOutcome& outcome);

  std::optional<double> tolerance_;
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

void ExactCast::cast(const Body& a, const Motion& motion_a, const Body& b, const Motion& motion_b,
                     CastOutcome& outcome) {
  constexpr int most_times = 4000;
  constexpr long exponent = -oracle::MovingCores::time_bits;
  const Integer end = Integer(1) << oracle::MovingCores::time_bits;
  const oracle::MovingCores cores(a, motion_a, b, motion_b);
  outcome.iterations = 0;
  outcome.status = Status::ok;
  ExactSearch search(cores, outcome.iterations);
  search.go_to(0);
  std::optional<IntegerVector> plane;
  const auto write_hit = [&](const Integer& lower, const Integer& upper) {
    outcome.answer = CastAnswer::hit;
    outcome.lower = oracle::round_down(lower, exponent);
    outcome.toi = outcome.upper = oracle::round_up(upper, exponent);
    if (plane) outcome.normal = normal_of(*plane);
  };
  if (search.in_contact()) {
    if (!oracle::is_zero(search.nearest().numerator)) plane = search.nearest().numerator;
    return write_hit(0, 0);
  }
  for (int k = 0; k < most_times; ++k) {
    // The bodies are apart at the search's time, and were before.
    const Integer left = end - search.time();
    if (search.is_free(left)) {
      outcome.answer = CastAnswer::miss;
      return;
    }
    plane = search.nearest().numerator;
    Integer steps = search.steps();
    if (steps < 1) steps = 1;
    const bool proven = search.is_free(steps);
    const Integer before = search.time();
    search.go_to(before + (steps < left ? steps : left));
    if (search.in_contact()) {
      // With a proof up to that time this cannot be, so that the step was one.
      if (!proven) return write_hit(before, search.time());
      break;
    }
    if (!proven && !search.was_free()) break;
  }
  outcome.status = Status::not_converged;
  outcome.lower = 0;
}

bool supports_exact(ShapeKind, ShapeKind kind_b, bool turns) {
  return !turns || kind_b != ShapeKind::halfspace;
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
       .supports = supports_exact,
       .make = [](const CastSettings& settings) { return std::make_unique<ExactCast>(settings); }}};
}

}  // namespace touchstone::entries
