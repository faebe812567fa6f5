#include "harness/campaign/block_run.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "harness/base/clock.h"
#include "harness/base/hash.h"
#include "harness/measure/noise.h"

namespace touchstone {
namespace {

constexpr double setup_seconds = 60;
constexpr double confidence = 0.95;
constexpr double patience = 4;  // times its share of the budget, for a set without an interval

// A sampler with the executor that it runs on.
template <class Made>
class Owning final : public Sampler {
 public:
  template <class Build>
  Owning(int width, const Build& build)
      : executor_(width, Pinning::one_a_thread), sampler_(build(executor_)) {}
  SampleReply sample(const SampleRequest& request) override { return sampler_.sample(request); }

 private:
  Executor executor_;
  Made sampler_;
};

}  // namespace

BlockRun::BlockRun(const RunContext& context, const BlockInput& input,
                   std::span<const NarrowSet> narrow, const CheckTable& checks, Schedule schedule)
    : context_(&context),
      input_(&input),
      narrow_(narrow),
      checks_(&checks),
      schedule_(std::move(schedule)),
      states_(schedule_.sets.size()),
      out_(schedule_.contestants.size()),
      workers_(schedule_.contestants.size()) {
  for (const RawRow& row : context.findings->rows()) {
    if (row.block == context.number) take_over(row);
  }
}

void BlockRun::take_over(const RawRow& row) {
  if (row.lost() || row.wrong()) {
    for (std::size_t i = 0; i < out_.size(); ++i) {
      const Contestant& contestant = schedule_.contestants[i];
      // A failure of the check pass is one of a set, and the schedule knows it.
      if (row.process >= 0 && contestant.label() == label_of(row) &&
          contestant.twin == row.is_twin()) {
        out_[i] = 1;
      }
    }
  }
  if (row.kind != RowKind::sample) return;
  for (std::size_t s = 0; s < schedule_.sets.size(); ++s) {
    MeasuredSet& set = schedule_.sets[s];
    if (set.key() != set_key(row)) continue;
    SetState& state = states_[s];
    state.times.add(row);
    state.done.insert({row.square, row.round});
    if (row.seconds >= 0) state.spent += row.seconds;
    if (row.frames > 0) set.window = static_cast<std::uint32_t>(row.frames);
    if (!row.stop.empty()) state.stopped = true;
  }
}

void BlockRun::run(const std::function<bool()>& commit) {
  commit_ = commit;
  const std::vector<Stage> plan =
      stages(context_->block->group->squares, context_->block->group->processes);
  for (const Stage& stage : plan) {
    for (const ProcessSpan& span : stage) {
      const bool ends_stage = &span == &stage.back();
      if (!run_process(span, ends_stage, ends_stage && &stage == &plan.back())) return;
    }
  }
}

bool BlockRun::any_left(const std::vector<std::size_t>& contestants) const {
  return std::ranges::any_of(contestants, [&](std::size_t c) { return out_[c] == 0; });
}

bool BlockRun::is_open(std::size_t s, const ProcessSpan& span) const {
  const MeasuredSet& set = schedule_.sets[s];
  if (states_[s].stopped || !any_left(set.members)) return false;
  for (int lap = span.first; lap < span.end; ++lap) {
    for (std::size_t group = 0; group < set.groups.size(); ++group) {
      const std::size_t rounds = rounds_of(*context_->block->group, set.groups[group].size());
      for (std::size_t round = 0; round < rounds; ++round) {
        if (!states_[s].done.contains({set.square(lap, group), static_cast<std::int64_t>(round)})) {
          return true;
        }
      }
    }
  }
  return false;
}

bool BlockRun::run_process(const ProcessSpan& span, bool ends_stage, bool ends_all) {
  std::vector<std::size_t> open;
  for (std::size_t s = 0; s < states_.size(); ++s) {
    if (is_open(s, span)) open.push_back(s);
  }
  bool go_on = true;
  for (std::size_t c = 0; c < out_.size() && go_on; ++c) {
    std::vector<std::size_t> sets;
    for (const std::size_t s : open) {
      if (std::ranges::find(schedule_.sets[s].members, c) != schedule_.sets[s].members.end()) {
        sets.push_back(s);
      }
    }
    if (sets.empty() || out_[c] != 0) continue;
    workers_[c] = start(c, span.process, sets);
    go_on = commit_();
  }
  for (const std::size_t s : open) {
    const MeasuredSet& set = schedule_.sets[s];
    for (int lap = span.first; lap < span.end; ++lap) {
      for (std::size_t group = 0; group < set.groups.size(); ++group) {
        const std::size_t rounds = rounds_of(*context_->block->group, set.groups[group].size());
        for (std::size_t round = 0; round < rounds; ++round) {
          if (!go_on || states_[s].stopped) break;
          if (states_[s].done.contains(
                  {set.square(lap, group), static_cast<std::int64_t>(round)})) {
            continue;
          }
          const bool ends_lap =
              round + 1 == rounds &&
              std::none_of(set.groups.begin() + static_cast<std::ptrdiff_t>(group) + 1,
                           set.groups.end(), [&](const auto& later) { return any_left(later); });
          const bool last = ends_lap && lap + 1 == span.end;
          run_round(
              {s, span.process, lap, group, round, ends_lap, last && ends_stage, last && ends_all});
          go_on = commit_();
        }
      }
    }
  }
  for (auto& worker : workers_) worker.reset();
  return go_on;
}

Worker::Make BlockRun::maker(std::size_t c) const {
  const Contestant& contestant = schedule_.contestants[c];
  const int width = context_->block->threads;
  if (contestant.broad != nullptr) {
    return [this, &contestant, width] {
      return std::make_unique<Owning<BroadSampler>>(width, [&](Executor& executor) {
        return BroadSampler(*contestant.broad, *input_, context_->block->group->rebuild, executor);
      });
    };
  }
  return [this, &contestant, width] {
    return std::make_unique<Owning<NarrowSampler>>(width, [&](Executor& executor) {
      return NarrowSampler(*contestant.narrow, *input_, narrow_, executor);
    });
  };
}

std::unique_ptr<Worker> BlockRun::start(std::size_t c, int process,
                                        const std::vector<std::size_t>& sets) {
  const std::uint64_t place = (static_cast<std::uint64_t>(context_->number) << 40) +
                              (static_cast<std::uint64_t>(process) << 20) + c;
  auto worker = std::make_unique<Worker>(
      maker(c), WorkerSettings{.memory = context_->block->group->memory_limit,
                               .layout = mix(context_->seed ^ mix(place))});
  if (const auto failure = worker->wait_until_made(setup_seconds)) {
    RawRow row = row_of(c, sets.front(), 0);
    row.process = process;
    add(lose(std::move(row), c, *failure));
    return nullptr;
  }
  verify(*worker, c, process, sets);
  return out_[c] != 0 ? nullptr : std::move(worker);
}

void BlockRun::verify(Worker& worker, std::size_t c, int process,
                      const std::vector<std::size_t>& sets) {
  for (std::size_t frame = 0; frame < input_->frames.size(); ++frame) {
    for (const std::size_t s : sets) {
      const MeasuredSet& set = schedule_.sets[s];
      if (set.narrow != nullptr && set.narrow->frames[frame].size() == 0) continue;
      const SampleRequest request = {
          .set = set.number, .frame = static_cast<std::uint32_t>(frame), .hashed = true};
      const auto reply = worker.ask(request, deadline(c, s, 1));
      if (reply && matches(*reply, c, s, request)) continue;
      RawRow row = row_of(c, s, frame);
      row.process = process;
      add(reply ? leave(std::move(row), c, RowStatus::wrong,
                        fmt::format("another answer at {} threads than in the check at one",
                                    context_->block->threads),
                        "", false)
                : lose(std::move(row), c, worker.failure()));
      return;
    }
  }
}

void BlockRun::run_round(const Place& place) {
  const MeasuredSet& set = schedule_.sets[place.set];
  SetState& state = states_[place.set];
  const std::vector<std::size_t>& group = set.groups[place.group];
  const LatinSquare order =
      square_order(*context_, place.set, set.square(place.lap, place.group), group.size());
  const std::uint32_t frame = set.first_frame(
      input_->frames.size(),
      static_cast<std::size_t>(place.lap) * rounds_of(*context_->block->group, group.size()) +
          place.round);
  std::vector<Taken> round;
  double waited = 0;
  const NoiseReading before = NoiseReading::now();
  const Stopwatch watch;
  for (std::size_t position = 0; position < group.size(); ++position) {
    const std::size_t c = group[order[place.round][position]];
    if (out_[c] != 0) continue;
    Taken taken = sample(place, c, frame);
    for (RawRow& row : taken.rows) row.position = static_cast<std::int64_t>(position);
    if (const double own = taken.rows.back().waited; own > 0) waited += own;
    round.push_back(std::move(taken));
  }
  const double seconds = watch.seconds();
  const std::string flags = noise_judge()(before, NoiseReading::now(), seconds, waited);
  state.spent += seconds;
  for (Taken& taken : round) {
    for (RawRow& row : taken.rows) {
      row.noise = flags;
      state.times.add(row);
    }
  }
  if (round.empty()) return;
  RawRow& last = round.back().rows.back();
  last.stop = reason_to_stop(place);
  if (!last.stop.empty()) {
    state.stopped = true;
    if (canary_sings(place)) last.noise += last.noise.empty() ? "canary" : "+canary";
  }
  for (Taken& taken : round) add(std::move(taken));
}

std::string BlockRun::reason_to_stop(const Place& place) const {
  const MeasuredSet& set = schedule_.sets[place.set];
  const SetState& state = states_[place.set];
  const CampaignGroup& group = *context_->block->group;
  if (!any_left(set.members)) return "crashed";
  if (place.ends_all) return "rounds";
  if (!place.ends_lap || group.squares) return "";
  if (place.ends_stage) {
    const std::string& baseline = state.times.baseline();
    bool narrow_enough = true;
    for (const std::string& label : state.times.labels()) {
      if (label == baseline) continue;
      const auto interval =
          stats::median_interval(state.times.log_ratios(label, baseline, false), confidence);
      narrow_enough = narrow_enough && half_width(interval) <= group.width;
    }
    if (narrow_enough) return "width";
  }
  // Below the squares of the first look there is no interval: worth some time beyond the budget.
  const double share = group.seconds / static_cast<double>(schedule_.sets.size());
  const bool looked = place.lap + 1 >= first_look;
  return state.spent > (looked ? 1 : patience) * share ? "budget" : "";
}

bool BlockRun::canary_sings(const Place& place) const {
  const SetTimes& times = states_[place.set].times;
  const double width = context_->block->group->width;
  if (times.baseline().empty()) return false;
  const auto interval = stats::median_interval(
      times.log_ratios(SetTimes::twin_of(times.baseline()), times.baseline(), false), confidence);
  return interval.low > std::log1p(width) || interval.high < -std::log1p(width);
}

}  // namespace touchstone
