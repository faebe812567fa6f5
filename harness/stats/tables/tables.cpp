// Computes the tables from samples.
#include "harness/stats/tables/tables.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "harness/stats/tables/fastest.h"
#include "harness/stats/tables/table_parts.h"

namespace touchstone::stats {
namespace {

// Corrects over a table: each row's p becomes its p_corrected.
template <class Row>
void correct(std::vector<Row>& rows, const auto& counts) {
  std::vector<double> p;
  for (const Row& row : rows) {
    if (counts(row)) p.push_back(row.p);
  }
  const std::vector<double> corrected = holm(p);
  std::size_t next = 0;
  for (Row& row : rows) row.p_corrected = counts(row) ? corrected[next++] : row.p;
}

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
  row.seconds = median_interval(values_of(by_square(contestant, noise)), confidence);
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
  const std::vector<double> ratios = paired_log_ratios(a, base, noise);
  return {set.key,
          a.label,
          base.label,
          canary,
          exponential(median_interval(ratios, confidence)),
          sign_test(ratios),
          1,
          set.suspect};
}

// Returns the first library of the set that was timed and is right; null if there is none.
const Contestant* library_of(const SampleSet& set, double depth_error) {
  for (const Contestant& contestant : set.contestants) {
    if (contestant.origin == record::RowOrigin::peer && !contestant.samples.empty() &&
        !contestant.failure && !is_wrong(set, contestant) &&
        !(worst_error(contestant) > depth_error)) {
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
    const TestedRatio tested = ratio_between(set, contestant, base, noise);
    rows.push_back(
        {set.key, contestant.label, base.label, false, tested.ratio, tested.p, 1, set.suspect});
  }
}

std::optional<WinnerRow> winner_row(const SampleSet& set, std::int64_t batch, Noise noise,
                                    double depth_error) {
  struct Entry {
    const Contestant* contestant;
    double ratio;  // logarithm of the ratio to the baseline
  };
  std::vector<Entry> entries;
  for (const Contestant& contestant : set.contestants) {
    if (contestant.batch != batch || is_wrong(set, contestant) || contestant.failure) continue;
    if (worst_error(contestant) > depth_error) continue;
    if (!set.key.narrow() && contestant.is_limit()) continue;
    // Ratios to the baseline compare contestants without a common square.
    const double ratio = median(paired_log_ratios(contestant, set.baseline(), noise));
    if (!std::isnan(ratio)) entries.push_back({&contestant, ratio});
  }
  if (entries.size() < 2) return std::nullopt;
  std::ranges::stable_sort(entries, {}, &Entry::ratio);
  const Contestant& winner = *entries[0].contestant;
  const Contestant& runner_up = *entries[1].contestant;
  const TestedRatio tested = ratio_between(set, runner_up, winner, noise);
  return WinnerRow{set.key,  batch, winner.label, runner_up.label, tested.ratio,
                   tested.p, 1,     set.suspect};
}

}  // namespace

TestedRatio ratio_between(const SampleSet& set, const Contestant& a, const Contestant& b,
                          Noise noise) {
  const LogRatio found = log_ratio(a, b, set.baseline(), noise, confidence);
  return {exponential(found.value), found.p};
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
    for (const std::int64_t batch : batches_of(set)) {
      if (auto row = winner_row(set, batch, noise, depth_error))
        tables.winners.push_back(*std::move(row));
    }
  }
  correct(tables.ratios, [](const RatioRow& row) { return !row.canary; });
  correct(tables.library_ratios, [](const RatioRow&) { return true; });
  correct(tables.winners, [](const WinnerRow&) { return true; });
  tables.exponents = exponent_rows(tables.times);
  tables.speed_ups = speed_up_rows(results, noise);
  tables.executors = executor_rows(results, noise);
  tables.broad_best = broad_best(results, noise, tables);
  tables.narrow_best = narrow_best(results, noise, tables);
  return tables;
}

}  // namespace touchstone::stats
