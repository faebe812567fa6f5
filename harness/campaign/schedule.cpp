#include "harness/campaign/schedule.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "harness/base/hash.h"
#include "harness/stats/statistics.h"

namespace touchstone {
namespace {

constexpr std::size_t group_size = 4;
constexpr std::array<int, 4> looks = {first_look, 12, 24, 48};  // squares of a group

// Seconds of a sample of the median contestant. Long enough for the clock and short enough for many
// rounds; less where a set's share of the time would not last for the first look.
constexpr double longest_sample = 3e-3;
constexpr double shortest_sample = 0.25e-3;
constexpr double greatest_window = 4096;  // frames

std::size_t index_of(std::vector<Contestant>& contestants, const Contestant& wanted) {
  const auto at = std::ranges::find(contestants, wanted);
  if (at != contestants.end()) return static_cast<std::size_t>(at - contestants.begin());
  contestants.push_back(wanted);
  return contestants.size() - 1;
}

// Sweep and prune, or GJK in double, cold; without it the first of ours, else the first.
std::size_t baseline(std::span<const Contestant> candidates) {
  const auto is_ours = [](const Contestant& c) { return c.info().origin == Origin::ours; };
  const auto is_usual = [](const Contestant& c) {
    return c.info().name == (c.broad != nullptr ? "sweep-and-prune" : "gjk") &&
           (c.narrow == nullptr ||
            (c.narrow->settings.scalar == Precision::float64 && !c.narrow->warm));
  };
  auto at = std::ranges::find_if(candidates, is_usual);
  if (at == candidates.end()) at = std::ranges::find_if(candidates, is_ours);
  return at == candidates.end() ? 0 : static_cast<std::size_t>(at - candidates.begin());
}

// Adds the set of these candidates, which are not empty.
void add_set(Schedule& schedule, MeasuredSet set, std::vector<Contestant> candidates) {
  const std::size_t first = baseline(candidates);
  std::swap(candidates[0], candidates[first]);
  Contestant twin = candidates[0];
  twin.twin = true;
  candidates.insert(candidates.begin() + 1, twin);
  for (const Contestant& candidate : candidates) {
    set.members.push_back(index_of(schedule.contestants, candidate));
  }
  // As even as can be: nobody meets the baseline alone because he came last.
  const std::size_t others = set.members.size() - 1;
  const std::size_t groups = (others + group_size - 2) / (group_size - 1);
  for (std::size_t g = 0; g < groups; ++g) {
    std::vector<std::size_t>& group = set.groups.emplace_back(1, set.members[0]);
    for (std::size_t i = g * others / groups; i < (g + 1) * others / groups; ++i) {
      group.push_back(set.members[i + 1]);
    }
  }
  schedule.sets.push_back(std::move(set));
}

}  // namespace

std::string Contestant::label() const {
  return broad != nullptr ? broad->info.name : narrow->label();
}

std::uint32_t MeasuredSet::first_frame(std::size_t frames, std::size_t round_of_group) const {
  const std::size_t wanted = starts.front() + (round_of_group * window) % (frames - starts.front());
  const auto at = std::ranges::lower_bound(starts, wanted);
  return static_cast<std::uint32_t>(at == starts.end() ? starts.front() : *at);
}

Schedule make_schedule(const RunContext& context, const BlockInput& input,
                       std::span<const NarrowSet> narrow, const CheckTable& checks) {
  const CampaignGroup& group = *context.block->group;
  const std::size_t frames = input.frames.size();
  Schedule schedule;
  const auto is_in = [&](const Contestant& contestant, const NarrowSet* set) {
    const Checked* checked = checks.find(contestant.label(), set);
    return checked != nullptr && !checked->out;
  };
  std::vector<Contestant> candidates;
  for (const BroadPhaseEntry* entry : context.broad()) {
    const Contestant contestant{.broad = entry};
    if (is_in(contestant, nullptr)) candidates.push_back(contestant);
  }
  if (!candidates.empty()) {
    MeasuredSet set;
    const bool updates = !group.rebuild && frames > 1;
    for (std::size_t frame = updates ? 1 : 0; frame < frames; ++frame) set.starts.push_back(frame);
    add_set(schedule, std::move(set), std::move(candidates));
  }
  for (std::size_t number = 0; number < narrow.size(); ++number) {
    const NarrowSet& pairs = narrow[number];
    candidates.clear();
    for (const NarrowChoice& choice : group.narrow) {
      const Contestant contestant{.narrow = &choice};
      if (offers(*choice.entry, pairs.kind_a, pairs.kind_b, pairs.task) &&
          context.admits(choice, pairs.broad, pairs.task, pairs.kind_name()) &&
          is_in(contestant, &pairs)) {
        candidates.push_back(contestant);
      }
    }
    if (candidates.empty()) continue;
    MeasuredSet set;
    set.narrow = &pairs;
    set.number = static_cast<std::uint32_t>(number);
    for (std::size_t frame = 0; frame < frames; ++frame) {
      if (pairs.frames[frame].size() > 0) set.starts.push_back(frame);
    }
    const auto is_warm = [](const Contestant& contestant) { return contestant.narrow->warm; };
    if (set.starts.back() == 0) {
      std::erase_if(candidates, is_warm);  // nothing comes before
      if (candidates.empty()) continue;
    }
    set.skips_first = std::ranges::any_of(candidates, is_warm);
    if (set.skips_first && set.starts.front() == 0) set.starts.erase(set.starts.begin());
    add_set(schedule, std::move(set), candidates);
  }

  for (MeasuredSet& set : schedule.sets) {
    std::vector<double> means;  // seconds a frame
    for (const std::size_t member : set.members) {
      const Checked& checked = *checks.find(schedule.contestants[member].label(), set.narrow);
      double sum = 0;
      for (std::size_t frame = set.starts.front(); frame < frames; ++frame) {
        sum += checked.seconds[frame];
      }
      means.push_back(sum / static_cast<double>(frames - set.starts.front()));
    }
    double samples = 0;  // until the first look
    for (const auto& contestants : set.groups) {
      samples += first_look *
                 static_cast<double>(contestants.size() * rounds_of(group, contestants.size()));
    }
    const double share = group.seconds / static_cast<double>(schedule.sets.size());
    const double seconds = std::clamp(share / samples, shortest_sample, longest_sample);
    const double mean = std::max(stats::median(std::move(means)), 1e-9);
    set.window =
        static_cast<std::uint32_t>(std::clamp(std::ceil(seconds / mean), 1.0, greatest_window));
  }
  return schedule;
}

std::vector<Stage> stages(std::optional<int> squares, int processes) {
  std::vector<Stage> all;
  int done = 0;
  int process = 0;
  const auto add = [&](int until) {
    Stage& stage = all.emplace_back();
    const int count = until - done;
    for (int i = 0; i < processes; ++i) {
      const int first = done + i * count / processes;
      const int end = done + (i + 1) * count / processes;
      if (end > first) stage.push_back({process++, first, end});
    }
    done = until;
  };
  if (squares) {
    add(*squares);
  } else {
    for (const int look : looks) add(look);
  }
  return all;
}

std::size_t rounds_of(const CampaignGroup& group, std::size_t size) {
  return group.rounds ? std::min(size, static_cast<std::size_t>(*group.rounds)) : size;
}

LatinSquare square_order(const RunContext& context, std::size_t set, std::int64_t square,
                         std::size_t size) {
  const std::uint64_t place = mix(mix(mix(static_cast<std::uint64_t>(context.number)) + set) +
                                  static_cast<std::uint64_t>(square));
  Random random(context.seed, place);
  return latin_square(size, random);
}

}  // namespace touchstone
