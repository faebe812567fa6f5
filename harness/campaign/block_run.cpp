// Plans the samples of a block, decides when a set stops, and makes rows and departures from rounds
// of samples.
#include "harness/campaign/block_run.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "harness/base/hash.h"
#include "harness/measure/phase_samplers.h"

namespace touchstone::campaign {
namespace {

record::Phase phase_of(std::string_view duration) {
  for (const record::Phase phase : {record::Phase::build, record::Phase::update,
                                    record::Phase::find_pairs, record::Phase::narrow}) {
    if (to_string(phase) == duration) return phase;
  }
  throw std::logic_error("a duration of a sample that is no phase");
}

}  // namespace

record::RawRow BlockRows::empty(std::size_t c, std::size_t s, std::size_t frame) const {
  const Candidate& candidate = schedule_.candidates[c];
  record::RawRow row = candidate.broad != nullptr
                           ? context_.row(frame, *candidate.broad, record::Phase::find_pairs)
                           : context_.row(frame, *candidate.narrow);
  row.executor = candidate.executor;
  if (candidate.control) row.twin = true;
  if (const measure::NarrowSet* const pairs = schedule_.pairs[s]; pairs != nullptr) {
    row.broad = pairs->broad;
    row.task = pairs->task;
    row.pair_kind = pairs->kind_name();
  }
  return row;
}

record::RawRow BlockRows::of_sample(const measure::Round& round,
                                    const measure::Sample& sample) const {
  record::RawRow row = empty(sample.contestant, round.set, round.request.frame);
  note_place(row, round, sample);
  row.frames = round.request.frames;
  return row;
}

std::vector<record::RawRow> BlockRows::of_reply(const measure::Round& round,
                                                const measure::Sample& sample, bool gave_up) const {
  const measure::SampleReply& reply = sample.reply;
  std::vector<record::RawRow> rows;
  for (const measure::Durations::Duration& duration : reply.durations.all()) {
    record::RawRow& row = rows.emplace_back(of_sample(round, sample));
    row.phase = phase_of(duration.name());
    row.seconds = duration.seconds;
  }
  record::RawRow& row = rows.back();
  note_counters(row, reply);
  row.worst_frame = reply.worst_frame;
  if (schedule_.pairs[round.set] == nullptr) {
    row.status = record::row_status(reply.status);
    return rows;
  }
  row.pair_hash = base::to_hex(reply.pair_hash);
  row.contact_count = reply.contacts;
  row.outcome_hash = base::to_hex(reply.outcome_hash);
  row.part_pairs = reply.part_pairs;
  row.iterations = reply.iterations;
  row.support_calls = reply.support_calls;
  const bool is_word = is_answerable(schedule_.candidates[sample.contestant].info().origin);
  row.status = gave_up   ? record::RowStatus::not_converged
               : is_word ? record::RowStatus::ok
                         : record::RowStatus::not_reported;
  return rows;
}

record::Departure BlockRows::mark_lost(record::RawRow& row, std::size_t c,
                                       const measure::Loss& loss, const std::string& wrong) const {
  const Candidate& candidate = schedule_.candidates[c];
  std::string where = context_.place(static_cast<std::size_t>(row.frame));
  if (!row.narrow.empty()) where += fmt::format(", {}, {}", row.pair_kind, to_string(*row.task));
  record::Departure departure = context_.departure(candidate.info(), candidate.label(), where);
  note_loss(row, loss);
  departure.known = row.status == record::RowStatus::timed_out;
  departure.what = (loss.wrong ? wrong : loss.failure.reason()) + "; left out from here on";
  return departure;
}

namespace {

constexpr double shares = 4;  // times its share of the budget, for a set without an interval
constexpr double slack = 10;  // times its time in the check, until a sample is stopped

}  // namespace

BlockRun::BlockRun(const RunContext& context, const measure::BlockInput& input,
                   std::span<const measure::NarrowSet> narrow, const CheckTable& checks,
                   Schedule schedule)
    : context_(context),
      input_(input),
      narrow_(narrow),
      checks_(checks),
      schedule_(std::move(schedule)),
      rows_(context, schedule_),
      times_(schedule_.sets.size()),
      progress_(schedule_.sets.size()),
      lost_(schedule_.candidates.size()) {
  for (const record::RawRow& row : context.findings->rows()) {
    if (row.block == context.number) take_over(row);
  }
}

void BlockRun::take_over(const record::RawRow& row) {
  if (row.lost() || row.wrong()) {
    for (std::size_t i = 0; i < lost_.size(); ++i) {
      const Candidate& candidate = schedule_.candidates[i];
      // A failure of the check pass is one of a set, and the schedule has it already.
      if (row.process >= 0 && candidate.label() == record::label_of(row) &&
          candidate.control == row.is_twin()) {
        lost_[i] = 1;
      }
    }
  }
  if (row.kind != record::RowKind::sample) return;
  for (std::size_t s = 0; s < schedule_.sets.size(); ++s) {
    if (schedule_.key(s) != set_key(row)) continue;
    times_[s].add(row);
    progress_[s].done.insert({row.square, row.round});
    if (row.seconds >= 0) progress_[s].spent += row.seconds;
    if (row.frames > 0) schedule_.sets[s].window = static_cast<std::uint32_t>(row.frames);
    if (!row.stop.empty()) progress_[s].stopped = true;
  }
}

measure::MeasurePlan BlockRun::plan() const {
  const CampaignGroup& group = *context_.block->group;
  measure::MeasurePlan plan;
  for (const Candidate& candidate : schedule_.candidates) {
    const measure::Threads threads = {context_.block->threads,
                                      candidate.executor.value_or(usual_executor)};
    plan.contestants.push_back(
        {candidate.label(), candidate.control,
         candidate.broad != nullptr
             ? measure::broad_maker(*candidate.broad, input_, group.rebuild, threads)
             : measure::narrow_maker(*candidate.narrow, input_, narrow_, threads)});
  }
  plan.sets = schedule_.sets;
  plan.periods = measure::periods(group.squares, group.processes);
  plan.memory = group.memory_limit;
  plan.seed = context_.seed;
  plan.number = static_cast<std::uint64_t>(context_.number);
  return plan;
}

void BlockRun::run(const std::function<bool()>& commit) {
  commit_ = commit;
  const measure::MeasurePlan whole = plan();
  measure::MeasuringLoop(whole, *this, progress_, lost_).run();
}

const Checked& BlockRun::checked(std::size_t c, std::size_t set) const {
  return *checks_.find(schedule_.candidates[c].algorithm(), schedule_.pairs[set]);
}

// Plays every frame once, to compare the answers in this process with those of the check.
std::vector<measure::MeasuringJob::Untimed> BlockRun::warm_up(std::size_t,
                                                              std::span<const std::size_t> sets,
                                                              const measure::ProcessLaps&) {
  std::vector<Untimed> all;
  for (std::size_t frame = 0; frame < input_.frames.size(); ++frame) {
    for (const std::size_t set : sets) {
      const measure::NarrowSet* const pairs = schedule_.pairs[set];
      if (pairs != nullptr && pairs->frames[frame].size() == 0) continue;
      all.push_back({set,
                     {.set = schedule_.sets[set].number,
                      .frame = static_cast<std::uint32_t>(frame),
                      .hashed = true}});
    }
  }
  return all;
}

double BlockRun::deadline(std::size_t c, std::size_t set, std::uint32_t frames) const {
  // The time includes the frames before the window, which may have to be played first.
  return context_.block->group->time_limit +
         slack * static_cast<double>(frames + input_.frames.size()) *
             checked(c, set).greatest_seconds();
}

bool BlockRun::is_right(std::size_t c, std::size_t s, const measure::SampleRequest& request,
                        const measure::SampleReply& reply) const {
  const bool is_broad = schedule_.pairs[s] == nullptr;
  const Checked& own = checked(c, s);
  const bool skips_first =
      request.skips_first || (is_broad && schedule_.sets[s].starts.front() == 1 && !request.hashed);
  std::int64_t pairs = 0;
  std::uint64_t hash = 0;
  std::size_t frame = request.frame;
  for (std::uint32_t i = 0; i < request.frames; ++i, ++frame) {
    if (frame == input_.frames.size()) frame = skips_first ? 1 : 0;
    pairs += own.pairs[frame];
    hash += own.hash[frame];
  }
  if (reply.pairs != pairs) return false;
  if (!is_broad) return reply.outcome_hash == hash;
  return !request.hashed || reply.pair_hash == hash;
}

void BlockRun::lose(std::size_t c, std::size_t set, int process, std::uint32_t frame,
                    const measure::Loss& loss) {
  record::RawRow row = rows_.empty(c, set, frame);
  row.process = process;
  record::Findings& findings = *context_.findings;
  record::Departure departure =
      rows_.mark_lost(row, c, loss,
                      fmt::format("another answer at {} threads than in the check at one",
                                  context_.block->threads));
  findings.add(std::move(row));
  findings.add(std::move(departure));
}

void BlockRun::take(measure::Round& round) {
  struct Taken {
    std::vector<record::RawRow> rows;  // the rows of one sample
    std::optional<record::Departure> departure;
  };
  std::vector<Taken> all;
  for (const measure::Sample& sample : round.samples) {
    Taken& taken = all.emplace_back();
    if (sample.loss) {
      record::RawRow& row = taken.rows.emplace_back(rows_.of_sample(round, sample));
      taken.departure = rows_.mark_lost(row, sample.contestant, *sample.loss,
                                        "another answer in a sample than in the check");
    } else {
      taken.rows = rows_.of_reply(round, sample, checked(sample.contestant, round.set).gave_up);
    }
    for (const record::RawRow& row : taken.rows) times_[round.set].add(row);
  }
  if (round.stop == measure::Stop::none) round.stop = reason_to_stop(round);
  if (round.stop != measure::Stop::none) {
    record::RawRow& last = all.back().rows.back();
    last.stop = to_string(round.stop);
    if (times_[round.set].twin_differs(context_.block->group->width)) note_canary(last);
  }
  for (Taken& taken : all) {
    for (record::RawRow& row : taken.rows) context_.findings->add(std::move(row));
    if (taken.departure) context_.findings->add(*std::move(taken.departure));
  }
}

measure::Stop BlockRun::reason_to_stop(const measure::Round& round) const {
  const CampaignGroup& group = *context_.block->group;
  if (!round.ends_lap || group.squares) return measure::Stop::none;
  if (round.ends_period && all_narrow(round.set)) return measure::Stop::width;
  // A set gets no interval before the first look, so until then it may exceed its budget.
  const double share = group.seconds / static_cast<double>(schedule_.sets.size());
  const bool looked = round.lap + 1 >= measure::first_look;
  return round.spent > (looked ? 1 : shares) * share ? measure::Stop::budget : measure::Stop::none;
}

bool BlockRun::all_narrow(std::size_t set) const {
  const SetTimes& times = times_[set];
  for (const std::string& label : times.labels()) {
    if (label == times.baseline()) continue;
    const auto interval = stats::median_interval(times.log_ratios(label, times.baseline(), false),
                                                 stats::usual_confidence);
    if (!(half_width(interval) <= context_.block->group->width)) return false;
  }
  return true;
}

}  // namespace touchstone::campaign
