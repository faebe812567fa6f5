// The loop over sets, processes, laps, groups and rounds.
#include "harness/measure/measuring_loop.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "harness/base/clock.h"
#include "harness/base/hash.h"
#include "harness/measure/noise.h"

namespace touchstone::measure {

std::string_view to_string(Stop stop) {
  constexpr std::array<std::string_view, 5> names = {"", "crashed", "rounds", "width", "budget"};
  return names[static_cast<std::size_t>(stop)];
}

MeasuringLoop::MeasuringLoop(const MeasurePlan& plan, MeasuringJob& job,
                             std::vector<SetProgress> progress, std::vector<char> lost)
    : plan_(plan), job_(job), progress_(std::move(progress)), lost_(std::move(lost)) {
  progress_.resize(plan.sets.size());
  lost_.resize(plan.contestants.size());
}

void MeasuringLoop::run() {
  for (const Period& period : plan_.periods) {
    for (const ProcessLaps& process : period) {
      const bool last_of_period = &process == &period.back();
      const bool last = last_of_period && &period == &plan_.periods.back();
      for (const std::vector<std::size_t>& share : shares()) {
        const std::vector<std::size_t> sets = open_sets(share, process);
        Workers workers(lost_.size());
        if (!start_workers(sets, process, workers)) return;
        for (const std::size_t set : sets) {
          for (int lap = process.first; lap < process.end; ++lap) {
            for (std::size_t group = 0; group < plan_.sets[set].groups.size(); ++group) {
              for (std::size_t round = 0; round < plan_.sets[set].rounds(group); ++round) {
                if (progress_[set].stopped || is_done(set, lap, group, round)) continue;
                run_round({set, process, last_of_period, last, lap, group, round}, workers);
                if (!job_.goes_on()) return;
              }
            }
          }
        }
      }
    }
  }
}

// Returns the sets that share their workers: all of them, or each alone.
std::vector<std::vector<std::size_t>> MeasuringLoop::shares() const {
  std::vector<std::size_t> all(plan_.sets.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  if (plan_.shares_workers) return {all};
  std::vector<std::vector<std::size_t>> each;
  for (const std::size_t set : all) each.push_back({set});
  return each;
}

std::vector<std::size_t> MeasuringLoop::open_sets(std::span<const std::size_t> sets,
                                                  const ProcessLaps& process) const {
  std::vector<std::size_t> open;
  std::ranges::copy_if(sets, std::back_inserter(open),
                       [&](std::size_t set) { return is_open(set, process); });
  return open;
}

bool MeasuringLoop::is_open(std::size_t s, const ProcessLaps& process) const {
  const MeasuredSet& set = plan_.sets[s];
  if (progress_[s].stopped || !any_left(set.members) || !job_.has_time(s, process)) return false;
  for (int lap = process.first; lap < process.end; ++lap) {
    for (std::size_t group = 0; group < set.groups.size(); ++group) {
      for (std::size_t round = 0; round < set.rounds(group); ++round) {
        if (!is_done(s, lap, group, round)) return true;
      }
    }
  }
  return false;
}

bool MeasuringLoop::is_done(std::size_t set, int lap, std::size_t group, std::size_t round) const {
  return progress_[set].done.contains(
      {plan_.sets[set].square(lap, group), static_cast<std::int64_t>(round)});
}

bool MeasuringLoop::any_left(std::span<const std::size_t> contestants) const {
  return std::ranges::any_of(contestants, [&](std::size_t c) { return lost_[c] == 0; });
}

// Returns false when the job ends the loop.
bool MeasuringLoop::start_workers(std::span<const std::size_t> sets, const ProcessLaps& process,
                                  Workers& workers) {
  for (std::size_t contestant = 0; contestant < lost_.size(); ++contestant) {
    std::vector<std::size_t> own;
    std::ranges::copy_if(sets, std::back_inserter(own), [&](std::size_t set) {
      const std::vector<std::size_t>& members = plan_.sets[set].members;
      return std::ranges::find(members, contestant) != members.end();
    });
    if (own.empty() || lost_[contestant] != 0) continue;
    workers[contestant] = start_worker(contestant, own, process);
    if (!job_.goes_on()) return false;
  }
  return true;
}

// Returns null when the contestant is lost before its first sample.
std::unique_ptr<Worker> MeasuringLoop::start_worker(std::size_t contestant,
                                                    std::span<const std::size_t> sets,
                                                    const ProcessLaps& process) {
  const auto lose = [&](std::size_t set, std::uint32_t frame, const Loss& loss) {
    lost_[contestant] = 1;
    job_.lose(contestant, set, process.process, frame, loss);
    return nullptr;
  };
  auto number = static_cast<std::uint64_t>(process.process);
  if (!plan_.shares_workers) number = number * plan_.sets.size() + sets.front();
  const std::uint64_t place = (plan_.number << 40) + (number << 20) + contestant;
  auto worker = std::make_unique<Worker>(
      plan_.contestants[contestant].make,
      WorkerSettings{.memory = plan_.memory, .layout = base::mix(plan_.seed ^ base::mix(place))});
  if (const auto failure = worker->wait_until_made(plan_.setup_seconds)) {
    return lose(sets.front(), 0, {.failure = *failure});
  }
  for (const auto& [set, request] : job_.warm_up(contestant, sets, process)) {
    const auto reply = worker->ask(request, job_.deadline(contestant, set, request.frames));
    if (!reply) return lose(set, request.frame, {.failure = worker->failure()});
    if (!job_.is_right(contestant, set, request, *reply)) {
      return lose(set, request.frame, {.wrong = true, .failure = {}});
    }
  }
  return worker;
}

void MeasuringLoop::run_round(const Place& place, Workers& workers) {
  const MeasuredSet& set = plan_.sets[place.set];
  const std::vector<std::size_t>& group = set.groups[place.group];
  Round round{.set = place.set,
              .group = place.group,
              .process = place.process.process,
              .lap = place.lap,
              .square = set.square(place.lap, place.group),
              .round = static_cast<std::int64_t>(place.round),
              .request = set.request(place.lap, place.group, place.round),
              .samples = {},
              .noise = {}};
  const LatinSquare order = square_order(plan_, place.set, round.square, group.size());
  double waited = 0;
  const NoiseReading before = NoiseReading::now();
  const base::Stopwatch watch;
  for (std::size_t position = 0; position < group.size(); ++position) {
    const std::size_t contestant = group[order[place.round][position]];
    if (lost_[contestant] != 0) continue;
    Sample taken = sample(contestant, place.set, round.request, workers[contestant]);
    taken.position = static_cast<std::int64_t>(position);
    if (taken.reply.waited > 0) waited += taken.reply.waited;
    round.samples.push_back(std::move(taken));
  }
  const double seconds = watch.seconds();
  round.noise = noise_judge()(before, NoiseReading::now(), seconds, waited);
  progress_[place.set].spent += seconds;
  if (round.samples.empty()) return;
  judge(place, round);
  job_.take(round);
  progress_[place.set].stopped = round.stop != Stop::none;
}

Sample MeasuringLoop::sample(std::size_t contestant, std::size_t set, const SampleRequest& request,
                             std::unique_ptr<Worker>& worker) {
  Sample sample{.contestant = contestant, .reply = {}, .loss = {}};
  const auto reply = worker->ask(request, job_.deadline(contestant, set, request.frames));
  if (!reply) {
    sample.loss = {.failure = worker->failure()};
  } else if (!job_.is_right(contestant, set, request, *reply)) {
    sample.loss = {.wrong = true, .failure = {}};
  } else {
    sample.reply = *reply;
    return sample;
  }
  lost_[contestant] = 1;
  worker.reset();
  return sample;
}

// Finds out which lap or period ends with a round.
void MeasuringLoop::judge(const Place& place, Round& round) {
  const MeasuredSet& set = plan_.sets[place.set];
  round.spent = progress_[place.set].spent;
  round.ends_lap =
      place.round + 1 == set.rounds(place.group) &&
      std::none_of(set.groups.begin() + static_cast<std::ptrdiff_t>(place.group) + 1,
                   set.groups.end(), [&](const auto& later) { return any_left(later); });
  const bool ends_process = round.ends_lap && place.lap + 1 == place.process.end;
  round.ends_period = ends_process && place.is_last_of_period;
  if (!any_left(set.members)) {
    round.stop = Stop::crashed;
  } else if (ends_process && place.is_last) {
    round.stop = Stop::rounds;
  }
}

}  // namespace touchstone::measure
