// Computes all grades of one answer.
#include "harness/grade/graded_answer.h"

#include <algorithm>
#include <cmath>

#include "harness/grade/pair_size.h"
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
      algorithm.info.origin == Origin::ours && !beyond_margins(algorithm, answer, extreme).empty();
  return answer;
}

}  // namespace touchstone::grade
