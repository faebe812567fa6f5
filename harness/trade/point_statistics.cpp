// Medians and intervals of the points' times.
#include "harness/trade/point_statistics.h"

#include <algorithm>
#include <cmath>

#include "harness/stats/statistics.h"

namespace touchstone::trade {
namespace {

constexpr std::size_t least_values = 6;  // the smallest number for an interval of 95 %

}  // namespace

// Returns the values of quiet rounds if they are enough for an interval, else those of all rounds.
std::vector<double> PointStatistics::Values::chosen() const {
  std::vector<double> values = quiet;
  if (quiet.size() < least_values) values.insert(values.end(), noisy.begin(), noisy.end());
  return values;
}

void PointStatistics::add(const measure::Round& round) {
  const auto is_baseline = [](const measure::Sample& sample) {
    return sample.contestant == 0 && !sample.loss;
  };
  const auto baseline = std::ranges::find_if(round.samples, is_baseline);
  if (baseline == round.samples.end()) return;
  const auto add = [&](Values& values, double value) {
    (round.noise.empty() ? values.quiet : values.noisy).push_back(value);
  };
  const double frames = round.request.frames;
  const double unit = baseline->reply.durations.sum() / frames;
  for (const measure::Sample& sample : round.samples) {
    if (sample.loss) continue;
    const double seconds = sample.reply.durations.sum() / frames;
    if (sample.contestant == 0) {
      add(baseline_, seconds);
    } else {
      add(ratios_[sample.contestant], std::log(seconds / unit));
    }
    if (sample.contestant == stages_.size()) continue;  // it is the control
    for (std::size_t k = 0; k < stage_names.size(); ++k) {
      stages_[sample.contestant][k].push_back(sample.reply.durations.of(stage_names[k]) / frames);
    }
  }
}

void PointStatistics::summarise(PointTimes& times) const {
  const std::vector<double> baseline = baseline_.chosen();
  const double unit = stats::median(baseline);
  for (std::size_t i = 0; i < times.points.size(); ++i) {
    TimedPoint& point = times.points[i];
    for (std::size_t k = 0; k < stage_names.size(); ++k) {
      if (!stages_[i][k].empty()) point.stages[k] = stats::median(stages_[i][k]);
    }
    if (i == 0) {
      const stats::MedianInterval interval = stats::median_interval(baseline, 0.95);
      point.rounds = static_cast<std::int64_t>(baseline.size());
      point.seconds = interval.median;
      point.low = interval.low;
      point.high = interval.high;
      continue;
    }
    const std::vector<double> ratios = ratios_[i].chosen();
    point.rounds = static_cast<std::int64_t>(ratios.size());
    if (ratios.empty() || !point.ok()) continue;
    const stats::MedianInterval interval = stats::exponential(stats::median_interval(ratios, 0.95));
    point.seconds = unit * interval.median;
    point.low = unit * interval.low;
    point.high = unit * interval.high;
  }
  const std::vector<double> control = ratios_.back().chosen();
  if (!control.empty()) times.control = std::exp(stats::median(control));
}

}  // namespace touchstone::trade
