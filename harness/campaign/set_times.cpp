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
  stats::Sample sample;
  sample.process = row.process;
  sample.square = row.square;
  sample.round = row.round;
  sample.position = row.position;
  sample.units = static_cast<double>(row.units());
  sample.noisy = !row.noise.empty() && row.noise != "canary";
  stats::add_phase(contestants_[label], row.phase, sample, row.seconds);
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

double half_width(const stats::MedianInterval& log_ratio) {
  return (std::exp(log_ratio.high) - std::exp(log_ratio.low)) / 2 / std::exp(log_ratio.median);
}

}  // namespace touchstone::campaign
