// Computes all grades of one answer, and adds them to counts.
#include "harness/grade/graded_answer.h"

#include <algorithm>
#include <cmath>

#include "harness/grade/margins.h"
#include "harness/grade/wrong.h"

namespace touchstone::grade {
namespace {

// Returns the greatest coordinate whose differences give a distance, in metres: a hull or a
// half-space may lie away from its own origin, and a half-space has no centre.
double greatest_coordinate(const files::Case& c) {
  double greatest = 0;
  for (const Shape* shape : {&c.shape_a, &c.shape_b}) {
    if (shape->kind == ShapeKind::hull) {
      for (const Vec3d& v : shape->hull->vertices) greatest = std::max(greatest, v.stableNorm());
    } else if (shape->kind == ShapeKind::halfspace) {
      greatest = std::max(greatest, std::abs(UnitHalfspace(*shape).offset));
      greatest = std::max(greatest, (c.pose_a.translation - c.pose_b.translation).stableNorm());
    }
  }
  return greatest;
}

// The part of that coordinate that counts as size; it matters only if bodies are points, or nearly
// so.
constexpr double coordinate_share = 1e-3;

}  // namespace

GradedAnswer grade_answer(const NarrowPhaseEntry& algorithm, bool extreme, const Query& query,
                          TrueCase& c, const Outcome& outcome) {
  GradedAnswer answer;
  answer.regime = query.regime;
  answer.entry = query.entry;
  answer.index = c.index();
  answer.kind_a = c.pair().shape_a.kind;
  answer.kind_b = c.pair().shape_b.kind;
  answer.scalar = query.scalar;
  answer.task = query.task;
  answer.encoding = encoding_of(algorithm, answer.kind_a, answer.kind_b, query.task, query.scalar);
  answer.answer = outcome.answer;
  answer.status = outcome.status;
  answer.iterations = outcome.iterations;
  const TrueCase::Truth& end = c.truth(Encoding::as_given);
  answer.exact = end.measure.answer;
  answer.lower = end.measure.lower;
  answer.upper = end.measure.upper;
  answer.end_to_end = grade(outcome, query.task, end.measure, end.pair.a(), end.pair.b());
  answer.given = answer.end_to_end;
  answer.given_lower = end.measure.lower;
  answer.given_upper = end.measure.upper;
  if (answer.encoding != Encoding::as_given) {
    const TrueCase::Truth& given = c.truth(answer.encoding);
    answer.given_lower = given.measure.lower;
    answer.given_upper = given.measure.upper;
    answer.given = grade(outcome, query.task, given.measure, given.pair.a(), given.pair.b());
  }
  answer.size = pair_size(c.pair());
  // Two points at one place have no size; their answers have bounds, in the least unit there is.
  constexpr double least_scale = 0x1p-900;
  answer.scale =
      std::max({answer.size, coordinate_share * greatest_coordinate(c.pair()), least_scale});
  for (const double end_of : {answer.lower, answer.upper, answer.given_lower, answer.given_upper}) {
    if (std::isfinite(end_of)) answer.scale = std::max(answer.scale, std::abs(end_of));
  }
  answer.witnesses = grade_witnesses(outcome, query.task, end.pair.a(), end.pair.b(), c.oracle());
  answer.beyond =
      is_answerable(algorithm.info.origin) && !beyond_margins(algorithm, answer, extreme).empty();
  return answer;
}

void keep_greater(double& worst, double value) {
  if (std::isnan(worst) || value > worst) worst = std::isnan(value) ? worst : value;
}

void AnswerCount::add(const GradedAnswer& answer) {
  const Grade& given = answer.given;
  const Grade& end = answer.end_to_end;
  const double scale = answer.scale;
  ++answers;
  switch (given.verdict) {
    case Verdict::silent_error: ++silent; break;
    case Verdict::honest_failure: ++honest; break;
    case Verdict::crashed: ++crashed; break;
    case Verdict::timed_out: ++timed_out; break;
    default: break;
  }
  if (answer.status == Status::not_reported) ++not_reported;
  if (end.verdict == Verdict::silent_error) ++silent_end;
  if (answer.exact == Answer::touching && end.verdict == Verdict::unscored) {
    ++touching;
    if (is_contact(answer.answer)) ++touching_contact;
  }
  if (!std::isnan(given.resolution)) ++within_resolution;
  keep_greater(resolution, given.resolution / scale);
  if (given.bounds_error > 0) ++bounds;
  if (answer.witnesses.not_a_number) ++not_a_number;
  if (answer.beyond) ++beyond;
  if (given.verdict == Verdict::honest_failure) {
    keep_greater(honest_margin, least_magnitude(answer.lower, answer.upper) / scale);
  }
  keep_greater(margin, given.margin / scale);
  keep_greater(margin_end, end.margin / scale);
  keep_greater(distance, std::abs(given.distance_error) / scale);
  keep_greater(distance_end, std::abs(end.distance_error) / scale);
  if (!std::isnan(given.depth_error)) {
    keep_greater(too_deep, std::max(given.depth_error, 0.0) / scale);
    keep_greater(too_shallow, std::max(-given.depth_error, 0.0) / scale);
  }
  keep_greater(depth_end, std::abs(end.depth_error) / scale);
  if (grades_depth(answer.task, given)) {
    keep_greater(does_not_separate, std::max(given.separation_error, 0.0) / scale);
    keep_greater(excess, given.excess / scale);
  }
  keep_greater(bounds_missed, end.bounds_error / scale);
  keep_greater(witness, answer.witnesses.off_body / scale);
  keep_greater(witness_length, std::abs(answer.witnesses.length_error) / scale);
  keep_greater(normal, answer.witnesses.normal_error);
}

void AnswerCount::add(const AnswerCount& other) {
  for (const auto count :
       {&AnswerCount::answers, &AnswerCount::not_reported, &AnswerCount::silent,
        &AnswerCount::silent_end, &AnswerCount::honest, &AnswerCount::crashed,
        &AnswerCount::timed_out, &AnswerCount::within_resolution, &AnswerCount::touching,
        &AnswerCount::touching_contact, &AnswerCount::bounds, &AnswerCount::not_a_number,
        &AnswerCount::beyond}) {
    this->*count += other.*count;
  }
  for (const auto worst :
       {&AnswerCount::resolution, &AnswerCount::honest_margin, &AnswerCount::margin,
        &AnswerCount::margin_end, &AnswerCount::distance, &AnswerCount::distance_end,
        &AnswerCount::too_deep, &AnswerCount::too_shallow, &AnswerCount::depth_end,
        &AnswerCount::does_not_separate, &AnswerCount::excess, &AnswerCount::bounds_missed,
        &AnswerCount::witness, &AnswerCount::witness_length, &AnswerCount::normal}) {
    keep_greater(this->*worst, other.*worst);
  }
}

}  // namespace touchstone::grade
