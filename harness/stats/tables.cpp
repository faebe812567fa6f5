// Computes the tables from samples.
#include "harness/stats/tables.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
namespace touchstone::stats {
namespace {

constexpr double confidence = 0.95;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::string origin_of(const Contestant& contestant) {
  return contestant.origin ? std::string(to_string(*contestant.origin)) : std::string();
}

std::vector<double> values_of(const std::map<SquareKey, double>& squares) {
  std::vector<double> values;
  for (const auto& [square, value] : squares) values.push_back(value);
  return values;
}

std::vector<double> logs(std::vector<double> values) {
  for (double& value : values) value = std::log(value);
  return values;
}

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

std::optional<AgreementRow> agreement_row(const SampleSet& set, const Contestant& contestant) {
  if (!set.key.narrow()) return std::nullopt;
  AgreementRow row{set.key, contestant.label, origin_of(contestant)};
  for (const Check& check : contestant.checks) {
    if (check.pair_count < 0) continue;
    const std::int64_t wrong = std::max<std::int64_t>(check.disagreements, 0);
    const std::int64_t failed = std::max<std::int64_t>(check.failures, 0);
    const std::int64_t compared = check.compared >= 0 ? check.compared : check.pair_count - failed;
    row.queries += check.pair_count;
    row.wrong += wrong;
    row.failed += failed;
    row.right += std::max<std::int64_t>(compared - wrong, 0);
    row.worst_error = std::fmax(row.worst_error, check.worst_error);
  }
  row.unanswered = std::max<std::int64_t>(row.queries - row.right - row.wrong - row.failed, 0);
  return row.queries > 0 ? std::optional(row) : std::nullopt;
}

TimeRow time_row(const SampleSet& set, const Contestant& contestant, Noise noise) {
  TimeRow row;
  row.key = set.key;
  row.label = contestant.label;
  row.origin = origin_of(contestant);
  row.seconds = median_interval(values_of(by_square(contestant, noise)), confidence);
  row.minimum = nan;
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

// Returns the log ratios of a contestant to the baseline, which compare contestants without a
// common square.
std::vector<double> to_baseline(const SampleSet& set, const Contestant& contestant, Noise noise) {
  return paired_log_ratios(contestant, set.baseline(), noise);
}

std::optional<WinnerRow> winner_row(const SampleSet& set, Noise noise, double depth_error) {
  struct Entry {
    const Contestant* contestant;
    double ratio;  // logarithm of the ratio to the baseline
  };
  std::vector<Entry> entries;
  for (const Contestant& contestant : set.contestants) {
    if (is_wrong(set, contestant) || contestant.failure) continue;
    if (worst_error(contestant) > depth_error) continue;
    if (!set.key.narrow() && contestant.label == limit_label) continue;
    const double ratio = median(to_baseline(set, contestant, noise));
    if (!std::isnan(ratio)) entries.push_back({&contestant, ratio});
  }
  if (entries.size() < 2) return std::nullopt;
  std::ranges::stable_sort(entries, {}, &Entry::ratio);
  const Contestant& winner = *entries[0].contestant;
  const Contestant& runner_up = *entries[1].contestant;
  const TestedRatio tested = ratio_between(set, runner_up, winner, noise);
  return WinnerRow{set.key, winner.label, runner_up.label, tested.ratio, tested.p, 1, set.suspect};
}

struct Points {
  std::vector<double> counts, seconds;
};

Points from(const Points& points, std::int64_t least) {
  Points some;
  for (std::size_t i = 0; i < points.counts.size(); ++i) {
    if (points.counts[i] < static_cast<double>(least)) continue;
    some.counts.push_back(points.counts[i]);
    some.seconds.push_back(points.seconds[i]);
  }
  return some;
}

std::vector<ExponentRow> exponent_rows(const std::vector<TimeRow>& times) {
  std::vector<ExponentRow> rows;
  std::vector<Points> points;
  for (const TimeRow& time : times) {
    if (time.key.narrow() || std::isnan(time.seconds.median)) continue;
    SetKey key = time.key;
    key.bodies = 0;
    key.seed = key.scene_hash = "";
    auto at = std::ranges::find_if(
        rows, [&](const ExponentRow& row) { return row.key == key && row.label == time.label; });
    if (at == rows.end()) {
      points.emplace_back();
      at = rows.insert(rows.end(), {key, time.label, {}, {}, {}});
    }
    at->counts.push_back(time.key.bodies);
    Points& own = points[static_cast<std::size_t>(at - rows.begin())];
    own.counts.push_back(static_cast<double>(time.key.bodies));
    own.seconds.push_back(time.seconds.median);
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].law = fit_power_law(points[i].counts, points[i].seconds, confidence);
    const Points many = from(points[i], many_bodies);
    rows[i].law_of_many = fit_power_law(many.counts, many.seconds, confidence);
    std::ranges::sort(rows[i].counts);
    const auto repeated = std::ranges::unique(rows[i].counts);
    rows[i].counts.erase(repeated.begin(), repeated.end());
  }
  std::erase_if(rows, [](const ExponentRow& row) { return std::isnan(row.law.exponent); });
  return rows;
}

std::vector<SpeedUpRow> speed_up_rows(const Results& results, Noise noise) {
  std::vector<SpeedUpRow> rows;
  for (const SampleSet& set : results.sets) {
    // The base is the same set with the fewest threads.
    const SampleSet* base = &set;
    bool alone = true;
    for (const SampleSet& other : results.sets) {
      SetKey key = other.key;
      key.threads = set.key.threads;
      if (key != set.key) continue;
      alone = alone && &other == &set;
      if (other.key.threads < base->key.threads) base = &other;
    }
    if (alone) continue;
    for (const Contestant& contestant : set.contestants) {
      const Contestant* const alike = base->find(contestant.label);
      if (alike == nullptr) continue;
      const MedianInterval speed_up =
          exponential(shift(logs(values_of(by_square(contestant, noise))),
                            logs(values_of(by_square(*alike, noise))), confidence));
      if (std::isnan(speed_up.median)) continue;
      rows.push_back({set.key, contestant.label, base->key.threads, speed_up});
    }
  }
  return rows;
}

std::optional<WorkRow> work_row(const SampleSet& set, const Contestant& contestant) {
  const bool narrow = set.key.narrow();
  WorkRow row{set.key, contestant.label, origin_of(contestant)};
  std::array<double, work_count> sums;
  sums.fill(nan);
  for (const Check& check : contestant.checks) {
    if (check.pair_count >= 0) {  // rows of a build or an update have none
      ++row.frames;
      row.queries += check.pair_count;
    }
    for (std::size_t i = 0; i < sums.size(); ++i) {
      if (check.work[i] < 0) continue;
      const auto count = static_cast<double>(check.work[i]);
      sums[i] = std::isnan(sums[i]) ? count : sums[i] + count;
    }
  }
  const auto per = [&](Work work, double units) {
    return units > 0 ? sums[static_cast<std::size_t>(work)] / units : nan;
  };
  const auto frames = static_cast<double>(row.frames);
  const auto queries = static_cast<double>(row.queries);
  const double body_frames = frames * static_cast<double>(set.key.bodies);
  row.box_tests = per(Work::box_tests, body_frames);
  row.node_visits = per(Work::node_visits, body_frames);
  row.candidates = per(Work::candidates, queries);
  row.bytes = per(Work::bytes, body_frames);
  row.iterations = per(Work::iterations, queries);
  row.support_calls = per(Work::support_calls, queries);
  row.allocations = per(Work::allocations, narrow ? queries : frames);
  row.allocated_bytes = per(Work::allocated_bytes, narrow ? queries : frames);
  const bool any = std::ranges::any_of(sums, [](double sum) { return !std::isnan(sum); });
  return any ? std::optional(row) : std::nullopt;
}

}  // namespace

bool is_wrong(const SampleSet& set, const Contestant& contestant) {
  if (set.key.narrow()) {
    return std::ranges::any_of(contestant.checks,
                               [](const Check& check) { return check.disagreements > 0; });
  }
  // The reference of each frame is the pairs of 'naive', else those that most contestants found.
  const Contestant* const naive = set.find("naive");
  return std::ranges::any_of(contestant.checks, [&](const Check& check) {
    if (check.pair_hash.empty()) return false;
    std::map<std::string, int> votes;
    for (const Contestant& voter : set.contestants) {
      if (naive != nullptr && &voter != naive) continue;
      for (const Check& other : voter.checks) {
        if (other.frame == check.frame && !other.pair_hash.empty()) ++votes[other.pair_hash];
      }
    }
    const auto most =
        std::ranges::max_element(votes, {}, [](const auto& vote) { return vote.second; });
    return most != votes.end() && votes[check.pair_hash] < most->second;
  });
}

TestedRatio ratio_between(const SampleSet& set, const Contestant& a, const Contestant& b,
                          Noise noise) {
  const LogRatio found = log_ratio(a, b, set.baseline(), noise, confidence);
  return {exponential(found.value), found.p};
}

double worst_error(const Contestant& contestant) {
  double worst = nan;
  for (const Check& check : contestant.checks) worst = std::fmax(worst, check.worst_error);
  return worst;
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
    if (auto row = winner_row(set, noise, depth_error)) tables.winners.push_back(*std::move(row));
  }
  correct(tables.ratios, [](const RatioRow& row) { return !row.canary; });
  correct(tables.library_ratios, [](const RatioRow&) { return true; });
  correct(tables.winners, [](const WinnerRow&) { return true; });
  tables.exponents = exponent_rows(tables.times);
  tables.speed_ups = speed_up_rows(results, noise);
  tables.broad_best = broad_best(results, noise, tables);
  tables.narrow_best = narrow_best(results, noise, tables);
  return tables;
}

}  // namespace touchstone::stats
