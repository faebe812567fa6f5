// Makes rows and departures from rounds of samples.
#include "harness/campaign/block_rows.h"

#include <fmt/core.h>

#include <stdexcept>

#include "harness/base/hash.h"

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
  row.kind = record::RowKind::sample;
  row.process = round.process;
  row.square = round.square;
  row.round = round.round;
  row.position = sample.position;
  row.frames = round.request.frames;
  row.noise = round.noise;
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
  row.pair_count = reply.pairs;
  row.worst_frame = reply.worst_frame;
  row.peak_kb = reply.peak_kb;
  row.minor_faults = reply.minor_faults;
  row.voluntary_switches = reply.voluntary_switches;
  row.involuntary_switches = reply.involuntary_switches;
  row.waited = reply.waited;
  row.cycles = reply.hardware.cycles;
  row.instructions = reply.hardware.instructions;
  row.branch_misses = reply.hardware.branch_misses;
  row.cache_misses = reply.hardware.cache_misses;
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
  const bool is_ours = schedule_.candidates[sample.contestant].info().origin == Origin::ours;
  row.status = gave_up   ? record::RowStatus::not_converged
               : is_ours ? record::RowStatus::ok
                         : record::RowStatus::not_reported;
  return rows;
}

record::Departure BlockRows::mark_lost(record::RawRow& row, std::size_t c,
                                       const measure::Loss& loss, const std::string& wrong) const {
  const Candidate& candidate = schedule_.candidates[c];
  const bool late = !loss.wrong && loss.failure.state == process::ItemState::timed_out;
  std::string where = context_.place(static_cast<std::size_t>(row.frame));
  if (!row.narrow.empty()) where += fmt::format(", {}, {}", row.pair_kind, to_string(*row.task));
  record::Departure departure = context_.departure(candidate.info(), candidate.label(), where);
  departure.known = late;
  departure.what = (loss.wrong ? wrong : loss.failure.reason()) + "; left out from here on";
  row.status = loss.wrong ? record::RowStatus::wrong
               : late     ? record::RowStatus::timed_out
                          : record::RowStatus::crashed;
  row.words = record::one_line(loss.wrong ? "" : loss.failure.words);
  return departure;
}

}  // namespace touchstone::campaign
