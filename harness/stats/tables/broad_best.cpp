// The table of broad phases: the best of ours against the best of the others.
#include <cmath>
#include <functional>

#include "harness/stats/tables/fastest.h"
#include "harness/stats/tables/table_parts.h"

namespace touchstone::stats {
namespace {

constexpr MedianInterval none = {nan, nan, nan, 0};

bool is_of_bullet_or_fcl(const Contestant& contestant) {
  return contestant.label.starts_with("bullet-") || contestant.label.starts_with("fcl-");
}

}  // namespace

std::vector<BroadBestRow> broad_best(const Results& results, Noise noise, const Tables& tables) {
  std::vector<BroadBestRow> rows;
  for (const SampleSet& set : results.sets) {
    if (set.key.narrow()) continue;
    const Contestant* const ours = fastest_right(set, noise, &Contestant::is_ours);
    if (ours == nullptr) continue;
    const auto best = [&](const std::function<bool(const Contestant&)>& takes_part) {
      const Contestant* const other = fastest_right(set, noise, takes_part);
      if (other == nullptr) return BroadBestRow::Best{"", nan, none};
      const TimeRow* const time = find_row(tables.times, set.key, other->label);
      return BroadBestRow::Best{other->label, time == nullptr ? nan : time->seconds.median,
                                ratio_between(set, *other, *ours, noise).ratio};
    };
    BroadBestRow& row = rows.emplace_back();
    row.key = set.key;
    row.ours = best(&Contestant::is_ours);
    row.peer = best([](const Contestant& c) { return !c.is_ours() && !c.is_limit(); });
    row.bullet_or_fcl = best(is_of_bullet_or_fcl);
    const auto limit = std::ranges::find_if(set.contestants, &Contestant::is_limit);
    row.over_limit =
        limit == set.contestants.end() ? none : ratio_between(set, *ours, *limit, noise).ratio;
    const WorkRow* const work = find_row(tables.work, set.key, ours->label);
    row.bytes_a_body = work == nullptr ? nan : work->bytes;
    const SpeedUpRow* const speed_up = find_row(tables.speed_ups, set.key, ours->label);
    const bool more = speed_up != nullptr && speed_up->base_threads < set.key.threads;
    row.base_threads = more ? speed_up->base_threads : 0;
    row.speed_up = more ? speed_up->speed_up : none;
    SetKey scene = set.key;
    scene.bodies = 0;
    scene.seed = scene.scene_hash = "";
    const ExponentRow* const exponent = find_row(tables.exponents, scene, ours->label);
    row.exponent = exponent == nullptr ? nan : exponent->law_of_many.exponent;
    row.worst_frame = worst_frame(*ours, noise);
  }
  return rows;
}

}  // namespace touchstone::stats
