// Judges the side of contact and measures the errors of numbers.
#include "harness/grade/grade.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace touchstone::grade {
namespace {

constexpr std::array<std::string_view, 7> verdict_names = {
    "right", "silent_error", "honest_failure", "crashed", "timed_out", "unsupported", "unscored"};

// Returns x less the nearest value of [lower, upper]. Equal infinities are no error.
double outside(double x, double lower, double upper) {
  if (x > upper) return x - upper;
  if (x < lower) return x - lower;
  return std::isnan(x) ? x : 0;
}

// Returns the distance between two enclosures, signed as in outside(); 0 if they overlap.
double apart(double lower, double upper, double other_lower, double other_upper) {
  if (lower > other_upper) return lower - other_upper;
  if (upper < other_lower) return upper - other_lower;
  return 0;
}

// Encloses the length by which b must move along n until the bodies are separated (negative: the
// gap along n). The difference of a body and a half-space is a half-space, which has a support in
// one direction only, and the reported direction seldom equals that one to the last bit. There the
// exact depth is divided by the cosine between the two directions.
oracle::Enclosure needed_along(const oracle::Measure& exact, const oracle::Body& a,
                               const oracle::Body& b, const Vec3d& n) {
  const oracle::Enclosure along = oracle::separation_along(a, b, n);
  const bool is_finite = std::isfinite(exact.lower) && std::isfinite(exact.upper);
  if (!std::isinf(along.lower) || !is_finite || exact.upper > 0) return along;
  const double cosine = exact.normal.stableNormalized().dot(n.stableNormalized());
  if (!(cosine > 0)) return along;
  return {-exact.upper / cosine, -exact.lower / cosine};
}

bool is_partly_nan(const Vec3d& v) {
  const auto count = v.array().isNaN().count();
  return count == 1 || count == 2;
}

double distance_from(const Vec3d& point, const oracle::Body& body, oracle::Oracle& oracle) {
  Shape dot;
  dot.kind = ShapeKind::sphere;
  const oracle::Solid solid(dot);
  const oracle::Body at(solid, Pose{Mat3d::Identity(), point});
  if (oracle.verdict(at, body) != Answer::separated) return 0;
  return oracle.measure(at, body).lower;
}

}  // namespace

std::string_view to_string(Verdict verdict) {
  return verdict_names[static_cast<std::size_t>(verdict)];
}

Verdict judge(const Outcome& outcome, Answer exact, Touching touching) {
  switch (outcome.status) {
    case Status::garbage:  // its program is ended then, as after a crash
    case Status::crashed: return Verdict::crashed;
    case Status::timed_out: return Verdict::timed_out;
    case Status::unsupported: return Verdict::unsupported;
    default: break;
  }
  if (!stands_by(outcome)) return Verdict::honest_failure;
  if (is_within_resolution(outcome)) return Verdict::right;
  if (exact == Answer::unknown) return Verdict::unscored;
  if (exact == Answer::touching && touching == Touching::unscored) return Verdict::unscored;
  return is_contact(outcome.answer) == is_contact(exact) ? Verdict::right : Verdict::silent_error;
}

double least_magnitude(double lower, double upper) {
  if (lower > 0) return lower;
  return upper < 0 ? -upper : 0;
}

double bounds_error(const Outcome& outcome, const oracle::Measure& exact) {
  if (std::isnan(outcome.lower) && std::isnan(outcome.upper)) return Grade::none;
  double error = 0;
  if (outcome.lower > exact.upper) error = outcome.lower - exact.upper;
  if (outcome.upper < exact.lower) error = std::max(error, exact.lower - outcome.upper);
  return error;
}

bool is_within_resolution(const Outcome& outcome) {
  return outcome.answer == Answer::touching && outcome.lower <= 0 && outcome.upper >= 0 &&
         outcome.lower < outcome.upper;
}

bool stands_by(const Outcome& outcome) {
  return outcome.answer != Answer::unknown &&
         (outcome.status == Status::ok || outcome.status == Status::not_reported);
}

Grade grade(const Outcome& outcome, Task task, const oracle::Measure& exact, const oracle::Body& a,
            const oracle::Body& b) {
  Grade grade;
  grade.verdict = judge(outcome, exact.answer);
  switch (grade.verdict) {
    case Verdict::crashed:
    case Verdict::timed_out:
    case Verdict::unsupported: return grade;
    case Verdict::silent_error: grade.margin = least_magnitude(exact.lower, exact.upper); break;
    default: break;
  }
  grade.bounds_error = bounds_error(outcome, exact);
  if (is_within_resolution(outcome)) grade.resolution = outcome.upper - outcome.lower;
  if (!stands_by(outcome) || !asks_for_number(task, outcome.answer)) return grade;
  // The number has nothing to be compared with if the exact answer is on the other side of contact.
  const bool both_apart =
      asks_distance(task) && outcome.answer != Answer::overlapping && !(exact.upper < 0);
  const bool both_meet =
      !both_apart && asks_depth(task) && outcome.answer != Answer::separated && !(exact.lower > 0);
  if (!both_apart && !both_meet) return grade;
  const double error = outside(outcome.distance, exact.lower, exact.upper);
  (both_apart ? grade.distance_error : grade.depth_error) = both_apart ? error : 0 - error;
  const Vec3d& n = outcome.normal;
  if (n.allFinite() && !n.isZero(0)) {
    const oracle::Enclosure along = needed_along(exact, a, b, n);
    grade.separation_error = outside(-outcome.distance, along.lower, along.upper);
    grade.separation_error = 0 - grade.separation_error;
    grade.excess = apart(along.lower, along.upper, -exact.upper, -exact.lower);
  }
  return grade;
}

WitnessGrade grade_witnesses(const Outcome& outcome, Task task, const oracle::Body& a,
                             const oracle::Body& b, oracle::Oracle& oracle) {
  WitnessGrade grade;
  const bool asked = asks_for_number(task, outcome.answer);
  const Vec3d &n = outcome.normal, &p = outcome.witness_a, &q = outcome.witness_b;
  if (!stands_by(outcome) || !asked) return grade;
  const bool endless = outcome.answer == Answer::overlapping && outcome.distance < 0;
  grade.not_a_number = std::isnan(outcome.distance) || (std::isinf(outcome.distance) && !endless) ||
                       std::ranges::any_of(std::array{n, p, q}, [](const Vec3d& v) {
                         return is_partly_nan(v) || v.array().isInf().any();
                       });
  const bool has_two_sides =
      outcome.answer == Answer::separated || outcome.answer == Answer::overlapping;
  grade.missing = has_two_sides && std::isfinite(outcome.distance) &&
                  std::ranges::any_of(std::array{n, p, q},
                                      [](const Vec3d& v) { return v.array().isNaN().all(); });
  if (n.allFinite()) grade.normal_error = std::abs(n.stableNorm() - 1);
  if (p.allFinite() && q.allFinite()) {
    grade.off_body = std::max(distance_from(p, a, oracle), distance_from(q, b, oracle));
    grade.length_error = (p - q).stableNorm() - std::abs(outcome.distance);
  }
  return grade;
}

}  // namespace touchstone::grade
