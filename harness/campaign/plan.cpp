// Plans a campaign by trials of a few frames and pairs.
#include "harness/campaign/plan.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "harness/base/clock.h"
#include "harness/campaign/blocks.h"
#include "harness/campaign/check_broad.h"
#include "harness/campaign/check_narrow.h"
#include "harness/campaign/check_pass.h"
#include "harness/campaign/schedule.h"
#include "harness/grade/answer_check.h"
#include "harness/measure/block_input.h"
#include "harness/stats/samples.h"

namespace touchstone::campaign {
namespace {

constexpr std::size_t tried_frames = 2;  // one is built, one an update
constexpr std::size_t tried_pairs = 48;  // the number of each set, from all frames

// Allocations are counted in two more passes over the same frames or pairs.
constexpr double trial_passes = 3;

// A block's check with findings of its own and without files. It counts no allocations, which would take a process more
// for each contestant.
struct Trial {
  record::Findings findings;
  RunContext context;

  explicit Trial(const RunContext& block) : context(block) {
    context.findings = &findings;
    context.results.clear();
    context.counts_allocations = false;
  }
};

double price_of(const RunContext& block, const BroadPhaseEntry& entry,
                const measure::BlockInput& first, double verifying, double times) {
  Trial trial(block);
  const base::Stopwatch watch;
  check_broad(trial.context, first, entry, false);
  const double once = watch.seconds();
  double solving = 0;
  for (const record::RawRow& row : trial.findings.rows()) {
    if (row.seconds >= 0) solving += row.seconds;
  }
  return once + (trial_passes - 1) * solving + (times - 1) * (verifying + trial_passes * solving);
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
    if (row.seconds >= 0)
      seconds += (trial_passes - 1 + trial_passes * more.at(set_key(row))) * row.seconds;
  }
  return seconds;
}

// Returns approximate seconds, from a check of the first frames and some pairs of each set, in
// child processes and without files. `frames` is the number of all frames, if the input has only
// the first ones.
double price_of_check(const RunContext& context, const measure::BlockInput& input,
                      std::size_t frames, std::span<const measure::NarrowSet> sets) {
  return price_of_broad(context, input, frames) +
         (sets.empty() ? 0 : price_of_narrow(context, input, sets));
}

constexpr int planned_frames = 2;

}  // namespace

std::vector<PlannedBlock> plan_campaign(const Campaign& campaign) {
  const CampaignBlocks blocks(campaign);
  std::vector<PlannedBlock> plan;
  for (std::int64_t number = 0; number < blocks.size(); ++number) {
    const RunContext context = blocks.context(number, nullptr);
    const CampaignGroup& group = *context.block->group;
    const IsaGuard guard(*context.block);
    PlannedBlock& planned = plan.emplace_back();
    planned.label = blocks.label(number);
    planned.seconds = group.seconds;
    const auto add = [&](std::string name, std::vector<std::string> contestants) {
      if (!contestants.empty()) planned.sets.push_back({std::move(name), std::move(contestants)});
    };
    std::vector<std::string> broad;
    for (const BroadPhaseEntry* entry : context.broad()) broad.push_back(entry->info.name);
    std::vector<std::string> listed;
    const auto list = [&](std::vector<std::string>& labels, const std::string& algorithm) {
      for (const auto executor : context.executors())
        labels.push_back(record::label_on(algorithm, executor));
    };
    for (const std::string& name : broad) list(listed, name);
    if (group.limit && !broad.empty()) list(listed, stats::limit_label);
    add("broad phases", listed);
    // Without narrow phases the first frames determine the time of all.
    const bool has_pairs = context.has_narrow();
    scene::Scene scene = *context.scene;
    const auto frames = static_cast<std::size_t>(
        scene.recording.empty() ? scene.frames : static_cast<int>(scene.recording.size()));
    if (!has_pairs) {
      scene.frames = std::min(scene.frames, planned_frames);
      if (!scene.recording.empty()) {
        scene.recording.resize(std::min<std::size_t>(frames, planned_frames));
      }
    }
    const base::Stopwatch watch;
    const measure::BlockInput input(scene, context.block->boxes, has_pairs);
    planned.check_seconds =
        watch.seconds() * static_cast<double>(frames) / static_cast<double>(input.frames.size());
    std::vector<measure::NarrowSet> sets;
    if (has_pairs) sets = context.true_sets(input);
    planned.check_seconds += price_of_check(context, input, frames, sets);
    if (!has_pairs) continue;
    if (!context.finds_pairs()) broad.assign(1, "");
    for (const std::string& source : broad) {
      for (const measure::NarrowSet& set : sets) {
        std::vector<std::string> narrow;
        for (const measure::NarrowChoice* choice : group.choices()) {
          if (offer(*choice, set, input) == measure::Offer::taken &&
              context.admits(*choice, source, set.task, set.kind_name())) {
            list(narrow, choice->label());
          }
        }
        add(fmt::format("{} {}{}{}", to_string(set.task), set.kind_name(),
                        source.empty() ? "" : " on the pairs of ", source),
            std::move(narrow));
      }
    }
  }
  return plan;
}

}  // namespace touchstone::campaign
