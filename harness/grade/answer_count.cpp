// Adds graded answers to counts and keeps the greatest errors.
#include "harness/grade/answer_count.h"

#include <algorithm>
#include <cmath>

namespace touchstone::grade {

void keep_greater(double& worst, double value) {
  if (std::isnan(worst) || value > worst) worst = std::isnan(value) ? worst : value;
}

AnswerCount::AnswerCount()
    : resolution(Grade::none),
      honest_margin(Grade::none),
      margin(Grade::none),
      margin_end(Grade::none),
      distance(Grade::none),
      distance_end(Grade::none),
      too_deep(Grade::none),
      too_shallow(Grade::none),
      depth_end(Grade::none),
      does_not_separate(Grade::none),
      excess(Grade::none),
      bounds_missed(Grade::none),
      witness(Grade::none),
      witness_length(Grade::none),
      normal(Grade::none) {}

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
