// Grades answers about pairs of convex bodies.
#include "harness/kinds/pair/pair_grade.h"

#include <cmath>

#include "harness/grade/margins.h"
#include "harness/grade/wrong.h"

namespace touchstone::kinds {
namespace {

// The grade of an answer that is no fault.
Grade grade_of_good(const NarrowPhaseEntry& entry, const grade::GradedAnswer& answer,
                    bool extreme) {
  const grade::Grade& given = answer.given;
  if (given.verdict == grade::Verdict::silent_error) return Grade::near;
  // The enclosure of bodies that touch exactly is 0.
  if (given.verdict == grade::Verdict::unscored && answer.given_lower < answer.given_upper) {
    return Grade::unresolved;
  }
  const double margin = grade::documented_margins(answer.scalar, extreme).length * answer.scale;
  const bool is_bound = entry.traits.depth_is_bound && given.depth_error > margin;
  return is_bound ? Grade::bound : Grade::right;
}

Grade grade_of_wrong(const NarrowPhaseEntry& entry, const grade::GradedAnswer& answer) {
  const bool is_wrong_side = !std::isnan(grade::wrong_margin(entry, answer));
  if (!is_wrong_side) return Grade::inexact;
  return grade::is_contact(answer.answer) ? Grade::false_hit : Grade::missed;
}

Grade grade_of(const NarrowPhaseEntry& entry, const grade::GradedAnswer& answer, bool extreme) {
  switch (grade::class_of(entry, answer, extreme)) {
    case grade::AnswerClass::crashed:
    case grade::AnswerClass::hung: return Grade::failed;
    case grade::AnswerClass::honest: return Grade::gave_up;
    case grade::AnswerClass::silent: return grade_of_wrong(entry, answer);
    case grade::AnswerClass::rounded:
    case grade::AnswerClass::right: break;
  }
  return grade_of_good(entry, answer, extreme);
}

}  // namespace

Graded grade_pair(const NarrowPhaseEntry& entry, const grade::GradedAnswer& answer, bool extreme) {
  return {grade_of(entry, answer, extreme), grade::is_contact(answer.exact)};
}

}  // namespace touchstone::kinds
