#include "harness/check/tally.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "harness/check/margins.h"

namespace touchstone {
namespace {

// Keeps the greater; numbers that are not known do not count.
void keep_greater(double& worst, double value) {
  if (std::isnan(worst) || value > worst) worst = std::isnan(value) ? worst : value;
}

}  // namespace

AnswerCount::AnswerCount()
    : honest_margin(Grade::none),
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
  if (answer.task == Task::penetration) {
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
        &AnswerCount::timed_out, &AnswerCount::touching, &AnswerCount::touching_contact,
        &AnswerCount::bounds, &AnswerCount::not_a_number, &AnswerCount::beyond}) {
    this->*count += other.*count;
  }
  for (const auto worst :
       {&AnswerCount::honest_margin, &AnswerCount::margin, &AnswerCount::margin_end,
        &AnswerCount::distance, &AnswerCount::distance_end, &AnswerCount::too_deep,
        &AnswerCount::too_shallow, &AnswerCount::depth_end, &AnswerCount::does_not_separate,
        &AnswerCount::excess, &AnswerCount::bounds_missed, &AnswerCount::witness,
        &AnswerCount::witness_length, &AnswerCount::normal}) {
    keep_greater(this->*worst, other.*worst);
  }
}

void FlipCount::add(const VariantCount& count) {
  compared += count.compared;
  flips += count.flips;
  lost += count.lost;
  beyond += count.beyond;
  worst_flip = std::max(worst_flip, count.worst_flip);
  worst_difference = std::max(worst_difference, count.worst_difference);
}

double badness(const GradedAnswer& answer) {
  if (answer.given.verdict == Verdict::crashed) return 1e9;
  if (answer.given.verdict == Verdict::timed_out) return 1e8;
  const double scale = answer.scale;
  double bad = 0;
  if (answer.given.verdict == Verdict::silent_error) {
    bad = 1e3 * (1 + answer.given.margin / scale);
  }
  const Margins margins = documented_margins(answer.scalar, true);
  for (const double error : {std::abs(answer.given.distance_error),
                             std::abs(answer.given.depth_error), answer.given.bounds_error}) {
    if (error > margins.length * scale) bad = std::max(bad, std::min(error / scale, 1e3));
  }
  return answer.witnesses.not_a_number ? std::max(bad, 1e2) : bad;
}

void Tally::add(const GradedAnswer& answer) {
  const Key key = {answer.entry, answer.scalar, answer.regime};
  answers_[key].add(answer);
  // Ours beyond the margins come before all that is within them.
  const double bad = answer.beyond ? 1e10 + badness(answer) : badness(answer);
  if (bad == 0) return;
  std::vector<Failure>& worst = failures_[key];
  const auto at = std::ranges::find_if(worst, [&](const Failure& f) { return f.badness < bad; });
  worst.insert(at, {bad, answer});
  if (worst.size() > kept) worst.pop_back();
}

void Tally::add(std::uint32_t regime, const VariantCount& count) {
  flips_[{count.entry, count.scalar, regime}].add(count);
  if (count.beyond > 0) variants_beyond_.push_back({regime, count});
}

void Tally::add(const JobSummary& summary) { jobs_.push_back(summary); }

std::vector<GradedAnswer> Tally::failures(const CheckRequest& request) const {
  std::vector<GradedAnswer> all;
  for (const auto& [key, worst] : failures_) {
    const bool ours = request.narrow[key.entry]->info.origin == Origin::ours;
    for (const Failure& failure : worst) {
      // Of ours, what is within the margins is no failure; of others one is enough.
      if (ours && !failure.answer.beyond) continue;
      all.push_back(failure.answer);
      if (!ours) break;
    }
  }
  return all;
}

bool Tally::ours_are_wrong() const {
  const auto any = [](const auto& counts) {
    return std::ranges::any_of(counts, [](const auto& c) { return c.second.beyond > 0; });
  };
  return any(answers_) || any(flips_) || std::ranges::any_of(jobs_, [](const JobSummary& job) {
           return job.refused + job.boxes_broken > 0;
         });
}

}  // namespace touchstone
