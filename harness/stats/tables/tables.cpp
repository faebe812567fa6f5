// Computes the tables from samples.
#include "harness/stats/tables/tables.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "harness/stats/tables/table_parts.h"

namespace touchstone::stats {
namespace {

std::vector<double> values_of(const std::map<SquareKey, double>& squares) {
  std::vector<double> values;
  for (const auto& [square, value] : squares) values.push_back(value);
  return values;
}

TimeRow time_row(const SampleSet& set, const Contestant& contestant, Noise noise) {
  TimeRow row;
  row.key = set.key;
  row.label = contestant.label;
  row.origin = contestant.origin;
  row.seconds = median_interval(values_of(by_square(contestant, noise)), usual_confidence);
  row.minimum = nan;
  row.worst_frame = worst_frame(contestant, noise);
  std::vector<double> all;
  std::array<std::vector<double>, phase_count> parts;
  for (const Sample& sample : contestant.samples) {
    ++row.samples;
    row.noisy += sample.noisy;
    const double value = sample.seconds() / sample.units;
    if (!std::isfinite(value)) continue;
    if (!(value >= row.minimum)) row.minimum = value;
    if (sample.noisy && noise == Noise::left_out) continue;
    all.push_back(value);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (!std::isnan(sample.parts[i])) parts[i].push_back(sample.parts[i] / sample.units);
    }
  }
  for (const Check& check : contestant.checks) {
    if (check.phase == record::Phase::convert) {
      parts[static_cast<std::size_t>(record::Phase::convert)].push_back(check.seconds);
    }
  }
  for (std::size_t i = 0; i < parts.size(); ++i) row.parts[i] = median(std::move(parts[i]));
  for (const double z : modified_z(all)) row.outliers += std::abs(z) > outlier_z;
  row.wrong = is_wrong(set, contestant);
  row.worst_error = worst_error(contestant);
  row.depth_is_bound = contestant.depth_is_bound;
  if (const auto agreement = agreement_row(set, contestant)) {
    row.queries = agreement->queries;
    row.unknown = agreement->failed + agreement->unanswered;
  }
  if (contestant.failure) row.failure = to_string(*contestant.failure);
  return row;
}

RatioRow ratio_row(const SampleSet& set, const Contestant& a, const Contestant& base, bool canary,
                   Noise noise) {
  const MedianInterval ratio = median_interval(paired_log_ratios(a, base, noise), usual_confidence);
  return {set.key, a.label, base.label, canary, exponential(ratio), set.suspect};
}

// Returns the first library of the set that was timed and is right; null if there is none.
const Contestant* library_of(const SampleSet& set, double depth_error) {
  for (const Contestant& contestant : set.contestants) {
    if (contestant.origin == record::RowOrigin::peer && !contestant.samples.empty() &&
        is_right(set, contestant, depth_error)) {
      return &contestant;
    }
  }
  return nullptr;
}

// Adds ratios to a library, or to the set's baseline if it has no library.
void add_library_ratios(const SampleSet& set, Noise noise, double depth_error,
                        std::vector<RatioRow>& rows) {
  const Contestant* const library = library_of(set, depth_error);
  const Contestant& base = library == nullptr ? set.baseline() : *library;
  for (const Contestant& contestant : set.contestants) {
    if (&contestant == &base || contestant.samples.empty()) continue;
    rows.push_back({set.key, contestant.label, base.label, false,
                    ratio_between(set, contestant, base, noise), set.suspect});
  }
}

// Adds the winner of a set and batch, or counts it as undecided.
void add_winner(const SampleSet& set, std::int64_t batch, Noise noise, Tables& tables) {
  const auto takes_part = [&](const Contestant& contestant) {
    return contestant.batch == batch && !contestant.is_limit() &&
           is_right(set, contestant, tables.depth_error);
  };
  const Contestant* const winner = fastest(set, noise, takes_part);
  const Contestant* const runner_up = fastest(set, noise, [&](const Contestant& contestant) {
    return &contestant != winner && takes_part(contestant);
  });
  const auto timed = std::ranges::count_if(set.contestants, [&](const Contestant& contestant) {
    return !contestant.samples.empty() && takes_part(contestant);
  });
  if (timed < 2) return;
  MedianInterval ratio = {nan, nan, nan, 0};
  if (runner_up != nullptr && !is_any_unheard(set, *winner, noise, takes_part)) {
    ratio = if_known(ratio_between(set, *runner_up, *winner, noise));
  }
  if (std::isnan(ratio.median)) {
    ++tables.undecided;
  } else {
    tables.winners.push_back({set.key, batch, winner->label, runner_up->label, ratio, set.suspect});
  }
}

}  // namespace

MedianInterval ratio_between(const SampleSet& set, const Contestant& a, const Contestant& b,
                             Noise noise) {
  const MedianInterval ratio =
      exponential(log_ratio(a, b, set.baseline(), noise, usual_confidence));
  return std::isnan(ratio.low) ? MedianInterval{nan, nan, nan, ratio.n} : ratio;
}

Tables make_tables(const Results& results, Noise noise, double depth_error) {
  Tables tables;
  tables.depth_error = depth_error;
  tables.campaign = results.campaign;
  for (const char* name : {"processor", "cores_online", "memory", "governor", "kernel", "compiler",
                           "flags", "instructions_in_use", "commit", "tree"}) {
    const auto at = results.machine.find(name);
    if (at != results.machine.end()) tables.machine.push_back(at->first + ": " + at->second);
  }
  for (const SampleSet& set : results.sets) {
    const Contestant& base = set.baseline();
    for (const Contestant& contestant : set.contestants) {
      tables.times.push_back(time_row(set, contestant, noise));
      if (&contestant != &base && !contestant.samples.empty()) {
        tables.ratios.push_back(ratio_row(set, contestant, base, false, noise));
      }
      if (auto row = work_row(set, contestant)) tables.work.push_back(*std::move(row));
      if (auto row = agreement_row(set, contestant)) tables.agreement.push_back(*std::move(row));
    }
    if (!set.twin.samples.empty()) {
      tables.ratios.push_back(ratio_row(set, set.twin, base, true, noise));
    }
    add_library_ratios(set, noise, depth_error, tables.library_ratios);
    for (const std::int64_t batch : batches_of(set)) add_winner(set, batch, noise, tables);
  }
  tables.exponents = exponent_rows(tables.times);
  tables.speed_ups = speed_up_rows(results, noise);
  tables.executors = executor_rows(results, noise);
  tables.broad_best = broad_best(results, noise, tables);
  tables.narrow_best = narrow_best(results, noise, tables);
  return tables;
}

}  // namespace touchstone::stats
