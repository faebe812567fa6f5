// The tables of growth with bodies, of speed-up by threads and of executors.
#include <algorithm>
#include <cmath>

#include "harness/stats/tables/table_parts.h"

namespace touchstone::stats {
namespace {

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

}  // namespace

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
    rows[i].law = fit_power_law(points[i].counts, points[i].seconds, usual_confidence);
    const Points many = from(points[i], many_bodies);
    rows[i].law_of_many = fit_power_law(many.counts, many.seconds, usual_confidence);
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
      const Contestant* alike = base->find(contestant.label);
      // At one thread there is no executor.
      if (alike == nullptr) alike = base->find(contestant.name());
      if (alike == nullptr) continue;
      const MedianInterval speed_up = exponential(shift(
          logs(by_square(contestant, noise)), logs(by_square(*alike, noise)), usual_confidence));
      if (std::isnan(speed_up.median)) continue;
      rows.push_back({set.key, contestant.label, base->key.threads, speed_up});
    }
  }
  return rows;
}

std::vector<ExecutorRow> executor_rows(const Results& results, Noise noise) {
  std::vector<ExecutorRow> rows;
  for (const SampleSet& set : results.sets) {
    for (const Contestant& contestant : set.contestants) {
      const Contestant& base =
          *std::ranges::find(set.contestants, contestant.name(), &Contestant::name);
      if (&base == &contestant || !base.executor || !contestant.executor) continue;
      const MedianInterval ratio = ratio_between(set, contestant, base, noise);
      if (std::isnan(ratio.median)) continue;
      rows.push_back(
          {set.key, contestant.name(), *contestant.executor, *base.executor, ratio, set.suspect});
    }
  }
  return rows;
}

}  // namespace touchstone::stats
