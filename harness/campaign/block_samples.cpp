// The rows of a block's samples, and of those that fail.
#include <fmt/core.h>

#include "harness/base/hash.h"
#include "harness/campaign/block_run.h"

namespace touchstone {
namespace {

constexpr double slack = 10;  // times its time in the check, before a sample is stopped

}  // namespace

bool BlockRun::matches(const SampleReply& reply, std::size_t c, std::size_t s,
                       const SampleRequest& request) const {
  const MeasuredSet& set = schedule_.sets[s];
  const Checked& checked = *checks_->find(schedule_.contestants[c].label(), set.narrow);
  const bool skips_first =
      request.skips_first || (set.narrow == nullptr && set.starts.front() == 1 && !request.hashed);
  std::int64_t pairs = 0;
  std::uint64_t hash = 0;
  std::size_t frame = request.frame;
  for (std::uint32_t i = 0; i < request.frames; ++i, ++frame) {
    if (frame == input_->frames.size()) frame = skips_first ? 1 : 0;
    pairs += checked.pairs[frame];
    hash += checked.hash[frame];
  }
  if (reply.pairs != pairs) return false;
  if (set.narrow != nullptr) return reply.outcome_hash == hash;
  return !request.hashed || reply.pair_hash == hash;
}

double BlockRun::deadline(std::size_t c, std::size_t s, std::size_t frames) const {
  const Checked& checked =
      *checks_->find(schedule_.contestants[c].label(), schedule_.sets[s].narrow);
  // A window may have to be played up to.
  return context_->block->group->time_limit +
         slack * static_cast<double>(frames + input_->frames.size()) * checked.greatest_seconds();
}

RawRow BlockRun::row_of(std::size_t c, std::size_t s, std::size_t frame) const {
  const Contestant& contestant = schedule_.contestants[c];
  const MeasuredSet& set = schedule_.sets[s];
  RawRow row = contestant.broad != nullptr
                   ? context_->row(frame, *contestant.broad, Phase::find_pairs)
                   : context_->row(frame, *contestant.narrow);
  if (contestant.twin) row.twin = true;
  if (set.narrow != nullptr) {
    row.broad = set.narrow->broad;
    row.task = set.narrow->task;
    row.pair_kind = set.narrow->kind_name();
  }
  return row;
}

BlockRun::Taken BlockRun::leave(RawRow row, std::size_t c, RowStatus status,
                                const std::string& what, const std::string& words, bool known) {
  const Contestant& contestant = schedule_.contestants[c];
  out_[c] = 1;
  workers_[c].reset();
  std::string where = context_->place(static_cast<std::size_t>(row.frame));
  if (!row.narrow.empty()) where += fmt::format(", {}, {}", row.pair_kind, to_string(*row.task));
  Departure departure = context_->departure(contestant.info(), contestant.label(), where);
  departure.known = known;
  departure.what = what + "; left out from here on";
  row.status = status;
  row.words = one_line(words);
  return {{std::move(row)}, std::move(departure)};
}

BlockRun::Taken BlockRun::lose(RawRow row, std::size_t c, const IsolationFailure& failure) {
  const bool late = failure.state == ItemState::timed_out;
  return leave(std::move(row), c, late ? RowStatus::timed_out : RowStatus::crashed,
               failure.reason(), failure.words, late);
}

void BlockRun::add(Taken taken) {
  for (RawRow& row : taken.rows) context_->findings->add(std::move(row));
  if (taken.departure) context_->findings->add(*std::move(taken.departure));
}

BlockRun::Taken BlockRun::sample(const Place& place, std::size_t c, std::uint32_t frame) {
  const MeasuredSet& set = schedule_.sets[place.set];
  const SampleRequest request = {
      .set = set.number, .frame = frame, .frames = set.window, .skips_first = set.skips_first};
  RawRow row = row_of(c, place.set, frame);
  row.kind = RowKind::sample;
  row.process = place.process;
  row.square = set.square(place.lap, place.group);
  row.round = static_cast<std::int64_t>(place.round);
  row.frames = set.window;
  const auto reply = workers_[c]->ask(request, deadline(c, place.set, set.window));
  if (!reply) {
    const IsolationFailure failure = workers_[c]->failure();
    return lose(std::move(row), c, failure);
  }
  if (!matches(*reply, c, place.set, request)) {
    return leave(std::move(row), c, RowStatus::wrong,
                 "another answer in a sample than in the check", "", false);
  }
  row.pair_count = reply->pairs;
  row.peak_kb = reply->peak_kb;
  row.minor_faults = reply->minor_faults;
  row.voluntary_switches = reply->voluntary_switches;
  row.involuntary_switches = reply->involuntary_switches;
  row.waited = reply->waited;
  row.cycles = reply->hardware.cycles;
  row.instructions = reply->hardware.instructions;
  row.branch_misses = reply->hardware.branch_misses;
  row.cache_misses = reply->hardware.cache_misses;
  row.seconds = reply->query;
  if (set.narrow != nullptr) {
    const Checked& checked = *checks_->find(schedule_.contestants[c].label(), set.narrow);
    row.pair_hash = to_hex(reply->pair_hash);
    row.contact_count = reply->contacts;
    row.outcome_hash = to_hex(reply->outcome_hash);
    row.iterations = reply->iterations;
    row.support_calls = reply->support_calls;
    row.status = checked.gave_up                                          ? RowStatus::not_converged
                 : schedule_.contestants[c].info().origin == Origin::ours ? RowStatus::ok
                                                                          : RowStatus::not_reported;
    return {{row}, {}};
  }
  row.status = row_status(reply->status);
  RawRow prepare = row_of(c, place.set, frame);
  prepare.kind = row.kind;
  prepare.process = row.process;
  prepare.square = row.square;
  prepare.round = row.round;
  prepare.frames = row.frames;
  prepare.phase = set.starts.front() == 0 ? Phase::build : Phase::update;
  prepare.seconds = reply->prepare;
  return {{prepare, row}, {}};
}

}  // namespace touchstone
