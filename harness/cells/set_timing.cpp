// Plans squares and workers, and makes rows of their samples.
#include "harness/cells/set_timing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <utility>

#include "algorithms/core/isa.h"
#include "harness/base/clock.h"
#include "harness/base/hash.h"
#include "harness/process/interrupt.h"

namespace touchstone::cells {
namespace {

constexpr double twin_width = 0.02;  // a baseline that differs from its twin by more is flagged
constexpr int processes = 3;         // that a contestant lives through
constexpr double slack = 10;         // times its time when it was graded, until a sample is stopped
constexpr double greatest_repeats = 1e6;
// A worker answers untimed for this part of a sample before its first one.
constexpr std::int64_t warm_up_part = 10;

class SetSampler final : public measure::Sampler {
 public:
  explicit SetSampler(const SetMember& member) : member_(member) {
    if (member.contestant->prepare) member.contestant->prepare();
  }
  // A request of no frames is the warm-up.
  measure::SampleReply sample(const measure::SampleRequest& request) override {
    const std::int64_t repeats = request.frames > 0
                                     ? member_.repeats
                                     : std::max<std::int64_t>(1, member_.repeats / warm_up_part);
    measure::SampleReply reply;
    const base::Stopwatch watch;
    for (std::int64_t k = 0; k < repeats; ++k) member_.contestant->answer();
    reply.durations.add(to_string(record::Phase::answer), watch.seconds());
    reply.pairs = member_.queries * repeats;
    if (member_.contestant->hash) reply.outcome_hash = member_.contestant->hash();
    return reply;
  }

 private:
  SetMember member_;
};

}  // namespace

std::vector<SetMember> with_twins(const std::vector<SetMember>& members) {
  std::vector<SetMember> all;
  for (std::size_t first = 0, end = 0; first < members.size(); first = end) {
    while (end < members.size() && members[end].planned == members[first].planned) ++end;
    const std::span<const SetMember> set = std::span(members).subspan(first, end - first);
    const auto ours = std::ranges::find_if(
        set, [](const SetMember& member) { return member.contestant->origin == Origin::ours; });
    const auto baseline = ours == set.end() ? set.begin() : ours;
    for (auto at = set.begin(); at != set.end(); ++at) {
      all.push_back(*at);
      if (at != baseline) continue;
      all.push_back(*at);
      all.back().twin = true;
    }
  }
  return all;
}

SquarePlan square_plan(int rounds, std::size_t contestants) {
  const auto up = [](std::size_t a, std::size_t b) { return (a + b - 1) / b; };
  const auto samples = static_cast<std::size_t>(rounds);
  const std::size_t squares = std::max<std::size_t>(measure::first_look, up(samples, contestants));
  return {static_cast<int>(squares), std::min(contestants, up(samples, squares))};
}

SetTiming::SetTiming(const CellRequest& request, std::int64_t number,
                     std::vector<SetMember> members, std::span<const record::RawRow> earlier)
    : request_(request),
      number_(number),
      members_(std::move(members)),
      lost_(members_.size()),
      times_(1 + static_cast<std::size_t>(members_.back().planned - members_.front().planned)) {
  for (SetMember& member : members_) {
    member.repeats = static_cast<std::int64_t>(std::clamp(
        std::ceil(request.sample_seconds / std::max(member.seconds, 1e-9)), 1.0, greatest_repeats));
  }
  for (const record::RawRow& row : earlier) take_over(row);
}

void SetTiming::take_over(const record::RawRow& row) {
  for (std::size_t i = 0; i < members_.size(); ++i) {
    SetMember& member = members_[i];
    if (member.contestant->name != row.algorithm || member.planned->name != row.family ||
        member.planned->group != row.input || member.twin != row.is_twin())
      continue;
    if (row.lost() || row.wrong()) lost_[i] = 1;
    if (row.repeats > 0) member.repeats = row.repeats;
    times_of(member).add(row);
  }
  if (row.square >= 0) progress_.done.insert({row.square, row.round});
  if (row.seconds >= 0) progress_.spent += row.seconds;
  if (!row.stop.empty()) progress_.stopped = true;
}

campaign::SetTimes& SetTiming::times_of(const SetMember& member) {
  return times_[static_cast<std::size_t>(member.planned - members_.front().planned)];
}

measure::MeasurePlan SetTiming::plan() const {
  measure::MeasurePlan plan;
  for (const SetMember& member : members_) {
    plan.contestants.push_back({member.contestant->name, member.twin,
                                [&member] { return std::make_unique<SetSampler>(member); }});
  }
  const SquarePlan squares = square_plan(request_.rounds, members_.size());
  measure::MeasuredSet& set = plan.sets.emplace_back();
  set.members.resize(members_.size());
  std::iota(set.members.begin(), set.members.end(), std::size_t{0});
  set.groups = {set.members};
  set.most_rounds = squares.rounds;
  plan.periods = measure::periods(squares.squares, processes);
  plan.setup_seconds += 4 * request_.time_limit;
  plan.seed = request_.seed;
  plan.number = static_cast<std::uint64_t>(number_);
  return plan;
}

void SetTiming::run(const TakeRows& take) {
  take_ = &take;
  const measure::MeasurePlan whole = plan();
  measure::MeasuringLoop(whole, *this, {progress_}, lost_).run();
}

std::vector<measure::MeasuringJob::Untimed> SetTiming::warm_up(std::size_t,
                                                               std::span<const std::size_t> sets,
                                                               const measure::ProcessLaps&) {
  std::vector<Untimed> all;
  for (const std::size_t set : sets) all.push_back({set, {.frames = 0}});
  return all;
}

double SetTiming::deadline(std::size_t contestant, std::size_t, std::uint32_t) const {
  const SetMember& member = members_[contestant];
  return request_.time_limit + slack * static_cast<double>(member.repeats) * member.seconds;
}

bool SetTiming::is_right(std::size_t contestant, std::size_t, const measure::SampleRequest&,
                         const measure::SampleReply& reply) const {
  return reply.outcome_hash == members_[contestant].hash;
}

record::RawRow SetTiming::row_of(const SetMember& member) const {
  record::RawRow row;
  row.campaign = request_.name;
  row.kind = record::RowKind::sample;
  row.block = number_;
  row.query_kind = request_.query_kind;
  row.input = member.planned->group;
  row.family = member.planned->name;
  row.algorithm = member.contestant->name;
  row.origin = record::row_origin(member.contestant->origin);
  row.bodies = row.frame = -1;
  row.boxes.reset();
  row.threads = member.planned->threads;
  row.isa = isa();
  row.repeats = member.repeats;
  if (member.twin) row.twin = true;
  row.phase = record::Phase::answer;
  return row;
}

record::RawRow SetTiming::row_of(const measure::Round& round, const measure::Sample& sample) const {
  record::RawRow row = row_of(members_[sample.contestant]);
  campaign::note_place(row, round, sample);
  if (sample.loss) return row;
  const measure::SampleReply& reply = sample.reply;
  campaign::note_counters(row, reply);
  row.seconds = reply.durations.sum();
  row.outcome_hash = base::to_hex(reply.outcome_hash);
  row.status = record::RowStatus::ok;
  return row;
}

namespace {

void mark_lost(record::RawRow& row, const measure::Loss& loss) {
  campaign::note_loss(row, loss);
  row.words = record::one_line(loss.wrong ? "another answer than the one that was graded"
                                          : loss.failure.reason() + " " + loss.failure.words);
}

}  // namespace

void SetTiming::lose(std::size_t contestant, std::size_t, int process, std::uint32_t,
                     const measure::Loss& loss) {
  record::RawRow row = row_of(members_[contestant]);
  row.process = process;
  mark_lost(row, loss);
  (*take_)({&row, 1});
}

void SetTiming::take(measure::Round& round) {
  std::vector<record::RawRow> rows;
  std::vector<std::size_t> last(times_.size(), SIZE_MAX);  // the place of each set's last row
  for (const measure::Sample& sample : round.samples) {
    record::RawRow& row = rows.emplace_back(row_of(round, sample));
    if (sample.loss) mark_lost(row, *sample.loss);
    const SetMember& member = members_[sample.contestant];
    times_of(member).add(row);
    last[static_cast<std::size_t>(&times_of(member) - times_.data())] = rows.size() - 1;
  }
  if (round.stop != measure::Stop::none) {
    for (std::size_t set = 0; set < last.size(); ++set) {
      if (last[set] == SIZE_MAX) continue;
      record::RawRow& row = rows[last[set]];
      row.stop = to_string(round.stop);
      if (times_[set].twin_differs(twin_width)) campaign::note_canary(row);
    }
  }
  (*take_)(rows);
}

bool SetTiming::goes_on() { return !process::InterruptGuard::raised(); }

}  // namespace touchstone::cells
