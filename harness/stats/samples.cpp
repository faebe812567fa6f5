// Sets of samples and the statistics of their squares.
#include "harness/stats/samples.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "harness/stats/statistics.h"

namespace touchstone::stats {

std::string_view to_string(Work work) {
  constexpr std::array<std::string_view, work_count> names = {
      "iterations", "iterations_squared", "support_calls",
      "box_tests",  "node_visits",        "candidates",
      "bytes",      "allocations",        "allocated_bytes"};
  return names[static_cast<std::size_t>(work)];
}

std::string SetKey::words() const {
  if (boxes.empty()) return scene;  // of a cell run, whose sets have nothing else
  std::string text = fmt::format("{}, {} bodies, {} boxes, {} thread{}", scene, bodies, boxes,
                                 threads, threads == 1 ? "" : "s");
  if (!seed.empty()) text += ", seed " + seed;
  if (!isa_limit.empty()) text += ", " + isa_limit + " instructions";
  if (rebuild) text += ", rebuilt";
  if (!narrow()) return text + ", broad phases";
  text += fmt::format(", {} {}", task, pair_kind);
  if (!pairs_of.empty()) text += " on the pairs of " + pairs_of;
  return text;
}

void add_phase(Contestant& contestant, record::Phase phase, Sample sample, double seconds) {
  const auto place = [](const Sample& s) {
    return std::tuple(s.process, s.square, s.round, s.position);
  };
  const auto at = static_cast<std::size_t>(phase);
  std::vector<Sample>& samples = contestant.samples;
  const bool is_new = samples.empty() || place(samples.back()) != place(sample) ||
                      !std::isnan(samples.back().parts[at]);
  if (is_new) {
    sample.parts.fill(nan);
    samples.push_back(sample);
  }
  samples.back().parts[at] = seconds;
  samples.back().noisy = samples.back().noisy || sample.noisy;
  if (!std::isnan(sample.worst_frame)) samples.back().worst_frame = sample.worst_frame;
}

void add_phase(Contestant& contestant, const record::RawRow& row) {
  Sample sample;
  sample.process = row.process;
  sample.square = row.square;
  sample.round = row.round;
  sample.position = row.position;
  sample.units = static_cast<double>(row.units());
  sample.noisy = !row.noise.empty() && row.noise != canary_flag;
  sample.frame = row.frame;
  sample.worst_frame = row.worst_frame;
  add_phase(contestant, row.phase, sample, row.seconds);
}

double Sample::seconds() const {
  double sum = nan;
  for (const double part : parts) {
    if (!std::isnan(part)) sum = std::isnan(sum) ? part : sum + part;
  }
  return sum;
}

const Contestant* SampleSet::find(const std::string& label) const {
  const auto at = std::ranges::find(contestants, label, &Contestant::label);
  return at == contestants.end() ? nullptr : &*at;
}

const Contestant& SampleSet::baseline() const {
  for (const std::string& label :
       {twin.label, std::string(key.narrow() ? "gjk double" : "sweep-one-axis")}) {
    if (const Contestant* found = find(label)) return *found;
  }
  const auto ours = std::ranges::find_if(contestants, &Contestant::is_ours);
  return ours == contestants.end() ? contestants.front() : *ours;
}

const SampleSet* Results::find(const SetKey& key) const {
  const auto at = std::ranges::find(sets, key, &SampleSet::key);
  return at == sets.end() ? nullptr : &*at;
}

std::map<SquareKey, double> by_square(const Contestant& contestant, Noise noise) {
  std::map<SquareKey, std::vector<double>> rounds;
  for (const Sample& sample : contestant.samples) {
    const double value = sample.seconds() / sample.units;
    if (std::isfinite(value) && value > 0 && (noise == Noise::kept || !sample.noisy)) {
      rounds[{sample.process, sample.square}].push_back(value);
    }
  }
  std::map<SquareKey, double> medians;
  for (auto& [square, values] : rounds) medians[square] = median(std::move(values));
  return medians;
}

double worst_frame(const Contestant& contestant, Noise noise) {
  std::map<std::int64_t, double> windows;
  for (const Sample& sample : contestant.samples) {
    if (std::isnan(sample.worst_frame)) continue;
    if (sample.noisy && noise == Noise::left_out) continue;
    const auto [at, is_new] = windows.try_emplace(sample.frame, sample.worst_frame);
    at->second = std::min(at->second, sample.worst_frame);
  }
  double worst = nan;
  for (const auto& [frame, seconds] : windows) {
    if (!(worst >= seconds)) worst = seconds;
  }
  return worst;
}

std::vector<double> logs(const std::map<SquareKey, double>& squares) {
  std::vector<double> values;
  for (const auto& [square, value] : squares) values.push_back(std::log(value));
  return values;
}

std::vector<double> paired_log_ratios(const Contestant& a, const Contestant& b, Noise noise) {
  const std::map<SquareKey, double> of_b = by_square(b, noise);
  std::vector<double> ratios;
  for (const auto& [square, value] : by_square(a, noise)) {
    const auto at = of_b.find(square);
    if (at != of_b.end()) ratios.push_back(std::log(value / at->second));
  }
  return ratios;
}

MedianInterval log_ratio(const Contestant& a, const Contestant& b, const Contestant& baseline,
                         Noise noise, double confidence) {
  const std::vector<double> paired = paired_log_ratios(a, b, noise);
  if (!paired.empty()) return median_interval(paired, confidence);
  const std::vector<double> of_a = paired_log_ratios(a, baseline, noise);
  const std::vector<double> of_b = paired_log_ratios(b, baseline, noise);
  return shift(of_b, of_a, confidence);
}

}  // namespace touchstone::stats
