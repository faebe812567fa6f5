// Sorts rows of samples into the times of a set.
#include "harness/campaign/set_times.h"

#include <cmath>

namespace touchstone::campaign {
namespace {

stats::Noise noise(bool noisy) { return noisy ? stats::Noise::kept : stats::Noise::left_out; }

}  // namespace

void SetTimes::add(const record::RawRow& row) {
  if (row.kind != record::RowKind::sample || !(row.seconds >= 0) || row.square < 0) return;
  std::string label = record::label_of(row);
  if (row.is_twin()) {
    baseline_ = label;
    label = twin_of(label);
  }
  stats::add_phase(contestants_[label], row);
}

std::vector<std::string> SetTimes::labels() const {
  std::vector<std::string> labels;
  for (const auto& [label, contestant] : contestants_) labels.push_back(label);
  return labels;
}

const stats::Contestant& SetTimes::find(const std::string& label) const {
  static const stats::Contestant none;
  const auto at = contestants_.find(label);
  return at == contestants_.end() ? none : at->second;
}

std::vector<double> SetTimes::times(const std::string& label, bool noisy) const {
  std::vector<double> times;
  for (const stats::Sample& sample : find(label).samples) {
    if (sample.units > 0 && (noisy || !sample.noisy)) {
      times.push_back(sample.seconds() / sample.units);
    }
  }
  return times;
}

std::vector<double> SetTimes::log_ratios(const std::string& a, const std::string& b,
                                         bool noisy) const {
  return stats::paired_log_ratios(find(a), find(b), noise(noisy));
}

bool SetTimes::twin_differs(double width) const {
  if (baseline_.empty()) return false;
  const auto interval = stats::median_interval(log_ratios(twin_of(baseline_), baseline_, false),
                                               stats::usual_confidence);
  return interval.low > std::log1p(width) || interval.high < -std::log1p(width);
}

void note_place(record::RawRow& row, const measure::Round& round, const measure::Sample& sample) {
  row.kind = record::RowKind::sample;
  row.process = round.process;
  row.square = round.square;
  row.round = round.round;
  row.position = sample.position;
  row.noise = round.noise;
}

void note_counters(record::RawRow& row, const measure::SampleReply& reply) {
  row.pair_count = reply.pairs;
  row.peak_kb = reply.peak_kb;
  row.minor_faults = reply.minor_faults;
  row.voluntary_switches = reply.voluntary_switches;
  row.involuntary_switches = reply.involuntary_switches;
  row.waited = reply.waited;
  row.cycles = reply.hardware.cycles;
  row.instructions = reply.hardware.instructions;
  row.branch_misses = reply.hardware.branch_misses;
  row.cache_misses = reply.hardware.cache_misses;
}

void note_loss(record::RawRow& row, const measure::Loss& loss) {
  row.status = loss.wrong                                            ? record::RowStatus::wrong
               : loss.failure.state == process::ItemState::timed_out ? record::RowStatus::timed_out
                                                                     : record::RowStatus::crashed;
  row.words = record::one_line(loss.wrong ? "" : loss.failure.words);
}

void note_canary(record::RawRow& row) {
  row.noise += (row.noise.empty() ? "" : "+") + std::string(stats::canary_flag);
}

double half_width(const stats::MedianInterval& log_ratio) {
  return (std::exp(log_ratio.high) - std::exp(log_ratio.low)) / 2 / std::exp(log_ratio.median);
}

}  // namespace touchstone::campaign
