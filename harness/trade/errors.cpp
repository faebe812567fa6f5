// Counts and sums of a configuration's errors.
#include "harness/trade/errors.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace touchstone::trade {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

constexpr double no_value = 1;  // error of an answer that has no number, as a part of the size

bool before(const IndexPair& a, const IndexPair& b) { return a.a != b.a ? a.a < b.a : a.b < b.b; }

double share(std::int64_t part, std::int64_t whole) {
  return whole == 0 ? 0 : static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace

std::size_t gap_bin(Answer truth, double gap) {
  if (grade::is_contact(truth) && std::isnan(gap)) return unknown_depth_bin;
  std::size_t decade = 0;
  while (decade < gap_decades.size() && std::abs(gap) < gap_decades[decade]) ++decade;
  return grade::is_contact(truth) ? decade : gap_bins - 1 - decade;
}

GapRange gap_range(std::size_t bin) {
  if (bin == unknown_depth_bin) return {Outcome::none, 0};
  const bool contact = bin <= gap_decades.size();
  const std::size_t decade = contact ? bin : gap_bins - 1 - bin;
  const double far = decade == 0 ? inf : gap_decades[decade - 1];
  const double near = decade == gap_decades.size() ? 0 : gap_decades[decade];
  return contact ? GapRange{-far, -near} : GapRange{near, far};
}

Spread spread_of(std::vector<double> values) {
  if (values.empty()) return {};
  std::ranges::sort(values);
  Spread spread;
  for (const double value : values) spread.mean += value / static_cast<double>(values.size());
  // The smallest value that 99 % of the errors do not exceed.
  const auto rank = static_cast<std::size_t>(std::ceil(0.99 * static_cast<double>(values.size())));
  spread.p99 = values[rank - 1];
  spread.greatest = values.back();
  return spread;
}

double PointErrors::wrong_share() const {
  return share(false_positives + false_negatives + failed + far, near + far);
}
double PointErrors::false_negative_share() const { return share(false_negatives, contacts); }

void ErrorCount::add(const TruePair& truth, const PairAnswer* answer) {
  if (truth.answer == Answer::unknown) return;
  const bool contact = grade::is_contact(truth.answer);
  const bool answered = answer == nullptr || answer->answer != Answer::unknown;
  const bool said_contact = answer != nullptr && grade::is_contact(answer->answer);
  // `touching` within bounds is right if they hold.
  const bool is_resolved =
      answer != nullptr && answer->answer == Answer::touching && truth.gap <= answer->upper;
  GapBin& bin = errors_.bins[gap_bin(truth.answer, truth.gap / truth.size)];
  ++bin.pairs;
  ++errors_.near;
  if (contact) ++errors_.contacts;
  if (!answered) {
    ++bin.failed;
    ++errors_.failed;
  } else if (said_contact != contact && !is_resolved) {
    ++bin.wrong;
    ++(contact ? errors_.false_negatives : errors_.false_positives);
  }
  if (task_ == Task::intersect) return;
  const bool wants_depth = task_ == Task::penetration;
  const double expected = contact != wants_depth ? 0 : std::abs(truth.gap);
  if (!std::isfinite(expected)) return;  // an unknown truth is no error of the answer
  double given = 0;
  if (answer == nullptr) {
    // The pair was not found, so it has no distance, unless a contact was missed: by its depth at
    // least.
    if (!wants_depth && !contact) return;
    if (!wants_depth) given = std::abs(truth.gap);
  } else if (!answered || said_contact == wants_depth) {
    // In this order of arguments NaN stays NaN.
    given = std::max(wants_depth ? -answer->distance : answer->distance, 0.0);
  }
  const double error = std::abs(given - expected) / truth.size;
  values_.push_back(std::isfinite(error) ? error : no_value);
}

void ErrorCount::add(const FrameTruth& truth, std::span<const PairAnswer> answers) {
  std::vector<const PairAnswer*> sorted;
  sorted.reserve(answers.size());
  for (const PairAnswer& answer : answers) sorted.push_back(&answer);
  std::ranges::sort(sorted, before, [](const PairAnswer* answer) { return answer->pair; });
  auto next = sorted.begin();
  const auto pass_far = [&](const IndexPair* until) {
    while (next != sorted.end() && (until == nullptr || before((*next)->pair, *until))) {
      if (grade::is_contact((*next)->answer)) ++errors_.far;
      ++next;
    }
  };
  for (const TruePair& pair : truth.pairs) {
    pass_far(&pair.pair);
    const bool found = next != sorted.end() && !before(pair.pair, (*next)->pair);
    add(pair, found ? *next : nullptr);
    if (found) ++next;
  }
  pass_far(nullptr);
}

PointErrors ErrorCount::errors() {
  errors_.values = static_cast<std::int64_t>(values_.size());
  errors_.value = spread_of(values_);
  return errors_;
}

}  // namespace touchstone::trade
