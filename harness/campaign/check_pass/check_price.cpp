// Estimates the cost of a check by trials.
#include "harness/campaign/check_pass/check_price.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "harness/base/clock.h"
#include "harness/campaign/check_pass/check_broad.h"
#include "harness/campaign/check_pass/check_narrow.h"
#include "harness/campaign/check_pass/check_table.h"
#include "harness/campaign/check_pass/exact_answers.h"
#include "harness/grade/pair_check.h"

namespace touchstone::campaign {
namespace {

constexpr std::size_t tried_frames = 2;  // one is built, one an update
constexpr std::size_t tried_pairs = 48;  // the number of each set, from all frames

// A block's check with findings of its own and without files.
struct Trial {
  record::Findings findings;
  RunContext context;

  explicit Trial(const RunContext& block) : context(block) {
    context.findings = &findings;
    context.results.clear();
  }
};

double price_of(const RunContext& block, const BroadPhaseEntry& entry,
                const measure::BlockInput& first, double verifying, double times) {
  Trial trial(block);
  const base::Stopwatch watch;
  check_broad(trial.context, first, entry, false);
  const double once = watch.seconds();
  double again = verifying;
  for (const record::RawRow& row : trial.findings.rows()) {
    if (row.seconds >= 0) again += row.seconds;
  }
  return once + (times - 1) * again;
}

double price_of_broad(const RunContext& context, const measure::BlockInput& input,
                      std::size_t frames) {
  measure::BlockInput first = input;
  first.frames.resize(std::min(first.frames.size(), tried_frames));
  const base::Stopwatch watch;
  for (const measure::BlockFrame& frame : first.frames) {
    std::vector<IndexPair> found = frame.truth;
    grade::check_pairs(found, frame.truth, {});
  }
  const double verifying = watch.seconds();
  const double times = static_cast<double>(frames) / static_cast<double>(first.frames.size());
  double seconds = 0;
  for (const BroadPhaseEntry* entry : context.broad()) {
    seconds += price_of(context, *entry, first, verifying, times);
  }
  return seconds;
}

measure::NarrowSet some_of(const measure::NarrowSet& set) {
  const std::size_t step = std::max<std::size_t>(set.pairs() / tried_pairs, 1);
  measure::NarrowSet some = set;
  std::size_t at = 0;
  for (grade::PairGroup& group : some.frames) {
    grade::PairGroup taken{group.kind_a, group.kind_b, {}, {}};
    for (std::size_t i = 0; i < group.size(); ++i, ++at) {
      if (at % step != 0) continue;
      taken.first.push_back(group.first[i]);
      taken.second.push_back(group.second[i]);
    }
    group = std::move(taken);
  }
  return some;
}

double price_of_narrow(const RunContext& context, const measure::BlockInput& input,
                       std::span<const measure::NarrowSet> sets) {
  std::vector<measure::NarrowSet> some;
  // For each set: the number of further pairs, in multiples of those tried.
  std::map<std::string, double> more;
  std::set<std::string> priced;
  ExactAnswers oracle(input);
  double seconds = 0;
  for (const measure::NarrowSet& set : sets) {
    const measure::NarrowSet& few = some.emplace_back(some_of(set));
    const double times = static_cast<double>(set.pairs()) / static_cast<double>(few.pairs()) - 1;
    more[set_key(set)] = times;
    // One exact answer serves all tasks of narrow phases.
    if (!priced.insert(ExactAnswers::key(set)).second) continue;
    const base::Stopwatch watch;
    for (std::size_t frame = 0; frame < few.frames.size(); ++frame) {
      oracle.solve(few, frame);
    }
    seconds += times * watch.seconds();
  }
  Trial trial(context);
  const base::Stopwatch watch;
  NarrowCheck(trial.context, input, some).run();
  seconds += watch.seconds();
  for (const record::RawRow& row : trial.findings.rows()) {
    if (row.seconds >= 0) seconds += more.at(set_key(row)) * row.seconds;
  }
  return seconds;
}

}  // namespace

double price_of_check(const RunContext& context, const measure::BlockInput& input,
                      std::size_t frames, std::span<const measure::NarrowSet> sets) {
  return price_of_broad(context, input, frames) +
         (sets.empty() ? 0 : price_of_narrow(context, input, sets));
}

}  // namespace touchstone::campaign
