#include "harness/measure/set_times.h"

#include <algorithm>
#include <cmath>

namespace touchstone {
namespace {

std::vector<double> differences(const std::map<std::int64_t, double>& a,
                                const std::map<std::int64_t, double>& b) {
  std::vector<double> values;
  for (const auto& [square, value] : a) {
    const auto at = b.find(square);
    if (at != b.end()) values.push_back(value - at->second);
  }
  return values;
}

}  // namespace

void SetTimes::add(const RawRow& row) {
  if (row.kind != RowKind::sample || !(row.seconds >= 0) || row.square < 0) return;
  std::string label = label_of(row);
  if (row.twin == 1) {
    baseline_ = label;
    label = twin_of(label);
  }
  std::vector<Sample>& samples = samples_[label];
  if (samples.empty() || samples.back().square != row.square || samples.back().round != row.round) {
    samples.push_back({row.square, row.round, row.position, 0,
                       static_cast<double>(row.narrow.empty() ? row.frames : row.pair_count),
                       !row.noise.empty() && row.noise != "canary"});
  }
  samples.back().seconds += row.seconds;
}

std::vector<std::string> SetTimes::labels() const {
  std::vector<std::string> labels;
  for (const auto& [label, samples] : samples_) labels.push_back(label);
  return labels;
}

std::vector<double> SetTimes::times(const std::string& label, bool noisy) const {
  std::vector<double> times;
  const auto at = samples_.find(label);
  if (at == samples_.end()) return times;
  for (const Sample& sample : at->second) {
    if (sample.units > 0 && (noisy || !sample.noisy)) {
      times.push_back(sample.seconds / sample.units);
    }
  }
  return times;
}

std::map<std::int64_t, double> SetTimes::by_square(const std::string& label, bool noisy) const {
  std::map<std::int64_t, std::vector<double>> rounds;
  const auto at = samples_.find(label);
  if (at != samples_.end()) {
    for (const Sample& sample : at->second) {
      if (sample.units > 0 && sample.seconds > 0 && (noisy || !sample.noisy)) {
        rounds[sample.square].push_back(sample.seconds / sample.units);
      }
    }
  }
  std::map<std::int64_t, double> medians;
  for (auto& [square, values] : rounds) {
    medians[square] = std::log(stats::median(std::move(values)));
  }
  return medians;
}

std::vector<double> SetTimes::log_ratios(const std::string& a, const std::string& b,
                                         bool noisy) const {
  const auto of_a = by_square(a, noisy);
  const auto of_b = by_square(b, noisy);
  std::vector<double> direct = differences(of_a, of_b);
  if (!direct.empty() || baseline_.empty()) return direct;
  const auto of_baseline = by_square(baseline_, noisy);
  const std::vector<double> left = differences(of_a, of_baseline);
  const std::vector<double> right = differences(of_b, of_baseline);
  for (std::size_t i = 0; i < std::min(left.size(), right.size()); ++i) {
    direct.push_back(left[i] - right[i]);
  }
  return direct;
}

double half_width(const stats::MedianInterval& log_ratio) {
  return (std::exp(log_ratio.high) - std::exp(log_ratio.low)) / 2 / std::exp(log_ratio.median);
}

}  // namespace touchstone
