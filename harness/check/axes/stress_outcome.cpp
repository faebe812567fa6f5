#include "harness/check/axes/stress_outcome.h"

#include <algorithm>
#include <cmath>

#include "harness/check/margins.h"

namespace touchstone {
namespace {

bool is_excused(const NarrowPhaseEntry& entry, const GradedAnswer& answer) {
  return entry.traits.approximate && is_contact(answer.answer);
}

// Of the numbers but the bounds; NaN where none is graded.
double number_error(const NarrowPhaseEntry& entry, const GradedAnswer& answer, const Grade& grade) {
  double worst = Grade::none;
  const auto add = [&](double error) {
    if (!std::isnan(error)) worst = std::isnan(worst) ? error : std::max(worst, error);
  };
  add(std::abs(grade.distance_error));
  add(-grade.depth_error);
  if (!entry.traits.depth_is_bound) add(grade.depth_error);
  if (answer.task == Task::penetration) add(grade.separation_error);
  return worst;
}

bool is_wrong(const NarrowPhaseEntry& entry, const GradedAnswer& answer, const Grade& grade,
              bool extreme) {
  const Margins margins = documented_margins(answer.scalar, extreme);
  if (grade.verdict == Verdict::silent_error && !is_excused(entry, answer)) return true;
  if (grade.bounds_error > margins.verdict * answer.scale) return true;
  return number_error(entry, answer, grade) > margins.length * answer.scale ||
         answer.witnesses.not_a_number;
}

}  // namespace

std::string_view to_string(StressOutcome outcome) {
  constexpr std::array<std::string_view, 6> names = {"right",  "rounded", "honest",
                                                     "silent", "crashed", "hung"};
  return names[static_cast<std::size_t>(outcome)];
}

StressOutcome outcome_of(const NarrowPhaseEntry& entry, const GradedAnswer& answer, bool extreme) {
  if (answer.given.verdict == Verdict::crashed) return StressOutcome::crashed;
  if (answer.given.verdict == Verdict::timed_out) return StressOutcome::hung;
  if (is_wrong(entry, answer, answer.given, extreme)) return StressOutcome::silent;
  if (answer.given.verdict == Verdict::honest_failure) return StressOutcome::honest;
  return is_wrong(entry, answer, answer.end_to_end, extreme) ? StressOutcome::rounded
                                                             : StressOutcome::right;
}

double wrong_margin(const NarrowPhaseEntry& entry, const GradedAnswer& answer) {
  if (answer.given.verdict != Verdict::silent_error || is_excused(entry, answer)) {
    return Grade::none;
  }
  return answer.given.margin / answer.scale;
}

double worst_error(const NarrowPhaseEntry& entry, const GradedAnswer& answer) {
  const double error = number_error(entry, answer, answer.given);
  const double bounds = answer.given.bounds_error;
  const double worst = std::isnan(error) || bounds > error ? bounds : error;
  return std::isnan(worst) ? worst : std::max(worst, 0.0) / answer.scale;
}

}  // namespace touchstone
