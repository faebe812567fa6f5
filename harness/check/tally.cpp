// Adds up the answers of a check and keeps the worst.
#include "harness/check/tally.h"

#include <algorithm>

#include "harness/grade/wrong.h"

namespace touchstone::check {

void Tally::add(const grade::GradedAnswer& answer) {
  const Key key = {answer.entry, answer.scalar, answer.regime};
  answers_[key].add(answer);
  // Answers of ours beyond the margins come before all that are within them.
  const double bad = answer.beyond ? 1e10 + badness(answer) : badness(answer);
  if (bad == 0) return;
  std::vector<Failure>& worst = failures_[key];
  const auto at = std::ranges::find_if(worst, [&](const Failure& f) { return f.badness < bad; });
  worst.insert(at, {bad, answer});
  if (worst.size() > kept) worst.pop_back();
}

void Tally::add(const VariantCount& count) {
  flips_[{count.entry, count.scalar, count.regime}].add(count);
  if (count.beyond > 0) variants_beyond_.push_back(count);
}

void Tally::add(const JobSummary& summary) { jobs_.push_back(summary); }

void Tally::add(const AxisCount& count) { axis_counts_.push_back(count); }

void Tally::add(const AxisSummary& summary) { axis_summaries_.push_back(summary); }

void Tally::add(const VerdictCount& count) {
  VerdictCount& sum = verdicts_[{count.entry, count.scalar, count.regime}];
  sum.entry = count.entry;
  sum.scalar = count.scalar;
  sum.regime = count.regime;
  sum.add(count);
}

void Tally::add(const FamilyCount& count) {
  FamilyCount& sum = families_[{count.contestant, count.family, count.form}];
  sum.family = count.family;
  sum.contestant = count.contestant;
  sum.form = count.form;
  sum.add(count);
}

std::vector<grade::GradedAnswer> Tally::failures(const CheckRequest& request) const {
  std::vector<grade::GradedAnswer> all;
  for (const auto& [key, worst] : failures_) {
    const bool ours = request.narrow[key.entry]->info.origin == Origin::ours;
    for (const Failure& failure : worst) {
      // An answer of ours within the margins is no failure; of other algorithms one failure is
      // enough.
      if (ours && !failure.answer.beyond) continue;
      all.push_back(failure.answer);
      if (!ours) break;
    }
  }
  return all;
}

}  // namespace touchstone::check
