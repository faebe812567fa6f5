// Grades answers about moving bodies.
#include "harness/kinds/cast/cast_grade.h"

#include <algorithm>
#include <cmath>

#include "harness/kinds/grading.h"

namespace touchstone::kinds {
namespace {

// True if the time of impact is too late, or so early that the bodies are further apart than the tolerance, or a
// bound is wrong.
bool is_off(const CastOutcome& outcome, const CastOutcome& exact, const CastAsked& asked,
            bool in_time, CastTruths& truths) {
  if (outcome.lower > exact.upper || outcome.upper < exact.lower) return true;
  const double path = truths.path(asked.place);
  const double late = in_time || path == 0 ? cast_late : asked.tolerance / path;
  if (!(outcome.toi <= exact.upper + late)) return true;
  return outcome.toi < exact.lower && truths.is_apart(asked.place, outcome.toi, asked.tolerance);
}

}  // namespace

double cast_tolerance(const CastEntry& entry, std::optional<double> asked, double path,
                      double size) {
  constexpr double usual = 1e-9;  // of the size
  const double unasked = entry.default_tolerance > 0 ? entry.default_tolerance : usual * size;
  return std::max(
      {asked.value_or(unasked), entry.fixed_tolerance, entry.fixed_share_of_path * path});
}

Graded grade_cast(const CastOutcome& outcome, const CastOutcome& exact, const CastAsked& asked,
                  bool in_time, CastTruths& truths) {
  const bool is_contact = exact.answer == CastAnswer::hit;
  const auto with = [&](Grade grade) { return Graded{grade, is_contact}; };
  const bool is_unknown = outcome.answer == CastAnswer::unknown;
  if (const auto by_status = grade_of_status(outcome.status, is_unknown)) return with(*by_status);
  if (exact.answer == CastAnswer::unknown) return with(Grade::unresolved);
  const bool contact = outcome.answer == CastAnswer::hit;
  if (is_contact && !contact) return with(Grade::missed);
  const double time = asked.reversed ? 1 - outcome.toi : outcome.toi;
  if (contact && !is_contact) {
    // Contact is said to be proven.
    if (!std::isnan(outcome.upper)) return with(Grade::false_hit);
    // The tolerance allows for no hit at the start of bodies that do not approach.
    if (asked.start == StartContact::approach && !(time > 0)) return with(Grade::false_hit);
    return with(truths.is_apart(asked.place, time, asked.tolerance) ? Grade::false_hit
                                                                    : Grade::near);
  }
  const bool is_inexact =
      contact && !asked.reversed && is_off(outcome, exact, asked, in_time, truths);
  return with(is_inexact ? Grade::inexact : Grade::right);
}

}  // namespace touchstone::kinds
