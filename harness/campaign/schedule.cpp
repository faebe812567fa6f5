// Plans the sets, groups and windows of a block.
#include "harness/campaign/schedule.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "harness/stats/statistics.h"

namespace touchstone::campaign {
namespace {

constexpr std::size_t group_size = 4;

// The time of a sample of the median candidate, seconds: long enough for the clock and short enough
// for many rounds. It is shorter if a set's share of the time would end before the first look.
constexpr double longest_sample = 3e-3;
constexpr double shortest_sample = 0.25e-3;
constexpr double greatest_window = 4096;  // frames
// An algorithm that is updated may do at once what serves the frames after. Its window is then all
// frames, or several times all, where the median candidate takes no more than this (seconds) and
// either the number of squares is fixed or a set's share of the time is enough for the first look.
constexpr double longest_pass = 0.2;

std::size_t index_of(std::vector<Candidate>& candidates, const Candidate& wanted) {
  const auto at = std::ranges::find(candidates, wanted);
  if (at != candidates.end()) return static_cast<std::size_t>(at - candidates.begin());
  candidates.push_back(wanted);
  return candidates.size() - 1;
}

// Finds the sweep on one axis, or cold GJK in double; without it the first of ours, else the first.
std::size_t baseline(std::span<const Candidate> candidates) {
  const auto is_ours = [](const Candidate& c) { return c.info().origin == Origin::ours; };
  const auto is_usual = [](const Candidate& c) {
    return c.info().name == (c.broad != nullptr ? "sweep-one-axis" : "gjk") &&
           (c.narrow == nullptr || (c.narrow->settings.scalar == Precision::float64 &&
                                    !c.narrow->warm && c.narrow->batch == measure::usual_batch));
  };
  auto at = std::ranges::find_if(candidates, is_usual);
  if (at == candidates.end()) at = std::ranges::find_if(candidates, is_ours);
  return at == candidates.end() ? 0 : static_cast<std::size_t>(at - candidates.begin());
}

// Adds the set of these candidates, which are not empty.
void add_set(Schedule& schedule, measure::MeasuredSet set, const measure::NarrowSet* pairs,
             std::vector<Candidate> candidates) {
  const std::size_t first = baseline(candidates);
  std::swap(candidates[0], candidates[first]);
  Candidate control = candidates[0];
  control.control = true;
  candidates.insert(candidates.begin() + 1, control);
  for (const Candidate& candidate : candidates) {
    set.members.push_back(index_of(schedule.candidates, candidate));
  }
  // The groups are as even as possible, so that no candidate meets the baseline alone.
  const std::size_t others = set.members.size() - 1;
  const std::size_t groups = (others + group_size - 2) / (group_size - 1);
  for (std::size_t g = 0; g < groups; ++g) {
    std::vector<std::size_t>& group = set.groups.emplace_back(1, set.members[0]);
    for (std::size_t i = g * others / groups; i < (g + 1) * others / groups; ++i) {
      group.push_back(set.members[i + 1]);
    }
  }
  schedule.sets.push_back(std::move(set));
  schedule.pairs.push_back(pairs);
}

// The starts are added by the caller.
measure::MeasuredSet empty_set(const CampaignGroup& group, std::size_t frames) {
  measure::MeasuredSet set;
  if (group.rounds) set.most_rounds = static_cast<std::size_t>(*group.rounds);
  set.frames = frames;
  set.starts.clear();
  return set;
}

}  // namespace

std::string Candidate::algorithm() const {
  return broad != nullptr ? broad->info.name : narrow->label();
}

std::string Candidate::label() const { return record::label_on(algorithm(), executor); }

Schedule make_schedule(const RunContext& context, const measure::BlockInput& input,
                       std::span<const measure::NarrowSet> narrow, const CheckTable& checks) {
  const CampaignGroup& group = *context.block->group;
  const std::size_t frames = input.frames.size();
  Schedule schedule;
  const auto is_in = [&](const Candidate& candidate, const measure::NarrowSet* set) {
    const Checked* checked = checks.find(candidate.algorithm(), set);
    return checked != nullptr && !checked->out;
  };
  std::vector<Candidate> candidates;
  for (const BroadPhaseEntry* entry : context.broad()) {
    for (const std::optional<ExecutorKind> executor : context.executors()) {
      const Candidate candidate{.broad = entry, .executor = executor};
      if (is_in(candidate, nullptr)) candidates.push_back(candidate);
    }
  }
  if (!candidates.empty()) {
    measure::MeasuredSet set = empty_set(group, frames);
    const bool updates = !group.rebuild && frames > 1;
    for (std::size_t frame = updates ? 1 : 0; frame < frames; ++frame) set.starts.push_back(frame);
    add_set(schedule, std::move(set), nullptr, std::move(candidates));
  }
  for (std::size_t number = 0; number < narrow.size(); ++number) {
    const measure::NarrowSet& pairs = narrow[number];
    candidates.clear();
    for (const measure::NarrowChoice* choice : group.choices()) {
      if (!is_timed(choice->info()) || offer(*choice, pairs, input) != measure::Offer::taken ||
          !context.admits(*choice, pairs.broad, pairs.task, pairs.kind_name())) {
        continue;
      }
      for (const std::optional<ExecutorKind> executor : context.executors()) {
        const Candidate candidate{.narrow = choice, .executor = executor};
        if (is_in(candidate, &pairs)) candidates.push_back(candidate);
      }
    }
    if (candidates.empty()) continue;
    measure::MeasuredSet set = empty_set(group, frames);
    set.number = static_cast<std::uint32_t>(number);
    for (std::size_t frame = 0; frame < frames; ++frame) {
      if (pairs.frames[frame].size() > 0) set.starts.push_back(frame);
    }
    const auto is_warm = [](const Candidate& candidate) { return candidate.narrow->warm; };
    if (set.starts.back() == 0) {
      std::erase_if(candidates, is_warm);  // there is no frame before
      if (candidates.empty()) continue;
    }
    set.skips_first = std::ranges::any_of(candidates, is_warm);
    if (set.skips_first && set.starts.front() == 0) set.starts.erase(set.starts.begin());
    add_set(schedule, std::move(set), &pairs, candidates);
  }

  for (std::size_t s = 0; s < schedule.sets.size(); ++s) {
    measure::MeasuredSet& set = schedule.sets[s];
    std::vector<double> means;  // seconds a frame
    for (const std::size_t member : set.members) {
      const Checked& checked =
          *checks.find(schedule.candidates[member].algorithm(), schedule.pairs[s]);
      double sum = 0;
      for (std::size_t frame = set.starts.front(); frame < frames; ++frame) {
        sum += checked.seconds[frame];
      }
      means.push_back(sum / static_cast<double>(frames - set.starts.front()));
    }
    double samples = 0;  // the number until the first look
    for (std::size_t g = 0; g < set.groups.size(); ++g) {
      samples += measure::first_look * static_cast<double>(set.groups[g].size() * set.rounds(g));
    }
    const double share = group.seconds / static_cast<double>(schedule.sets.size());
    const double seconds = std::clamp(share / samples, shortest_sample, longest_sample);
    const double average =
        std::accumulate(means.begin(), means.end(), 0.0) / static_cast<double>(means.size());
    const double mean = std::max(stats::median(std::move(means)), 1e-9);
    double window = std::clamp(std::ceil(seconds / mean), 1.0, greatest_window);
    const auto pass = static_cast<double>(frames - set.starts.front());
    const bool updates = schedule.pairs[s] == nullptr && set.starts.front() > 0;
    const bool is_long = mean * pass > longest_pass || pass > greatest_window;
    if (updates && !is_long && (group.squares || samples * average * pass <= share)) {
      const double passes = std::min(std::ceil(window / pass), std::floor(greatest_window / pass));
      window = passes * pass;
    }
    set.window = static_cast<std::uint32_t>(window);
  }
  return schedule;
}

}  // namespace touchstone::campaign
