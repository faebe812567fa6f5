// Finds the fastest contestants of a set, and makes the tables of the best of ours against the best
// of the others.
#include <cmath>
#include <optional>
#include <utility>

#include "harness/stats/tables/table_parts.h"

namespace touchstone::stats {
namespace {

constexpr MedianInterval none = {nan, nan, nan, 0};

bool is_of_bullet_or_fcl(const Contestant& contestant) {
  return contestant.label.starts_with("bullet-") || contestant.label.starts_with("fcl-");
}

// Returns the fastest; where all that take part were disturbed, the first, which has no ratio.
const Contestant* fastest_or_first(const SampleSet& set, Noise noise, const TakesPart& takes_part) {
  if (const Contestant* const found = fastest(set, noise, takes_part)) return found;
  const auto first = std::ranges::find_if(set.contestants, [&](const Contestant& contestant) {
    return !contestant.samples.empty() && !contestant.failure && takes_part(contestant);
  });
  return first == set.contestants.end() ? nullptr : &*first;
}

BroadBestRow broad_best_of(const SampleSet& set, const Contestant& ours, Noise noise,
                           const Tables& tables) {
  const auto is_rival = [&](const Contestant& contestant) {
    return !contestant.is_limit() && is_right(set, contestant, tables.depth_error);
  };
  const bool unheard = is_any_unheard(set, ours, noise, is_rival);
  const auto best = [&](const TakesPart& takes_part) {
    const Contestant* const other = fastest_or_first(set, noise, [&](const Contestant& contestant) {
      return is_rival(contestant) && takes_part(contestant);
    });
    if (other == nullptr) return BroadBestRow::Best{"", nan, none};
    const TimeRow* const time = find_row(tables.times, set.key, other->label);
    return BroadBestRow::Best{other->label, time == nullptr ? nan : time->seconds.median,
                              unheard ? none : ratio_between(set, *other, ours, noise)};
  };
  BroadBestRow row;
  row.key = set.key;
  row.ours = best(&Contestant::is_ours);
  row.peer = best([](const Contestant& contestant) { return contestant.is_others(); });
  row.bullet_or_fcl = best(is_of_bullet_or_fcl);
  const auto limit = std::ranges::find_if(set.contestants, &Contestant::is_limit);
  row.over_limit = limit == set.contestants.end() ? none : ratio_between(set, ours, *limit, noise);
  const WorkRow* const work = find_row(tables.work, set.key, ours.label);
  row.bytes_a_body = work == nullptr ? nan : work->bytes;
  const SpeedUpRow* const speed_up = find_row(tables.speed_ups, set.key, ours.label);
  const bool more = speed_up != nullptr && speed_up->base_threads < set.key.threads;
  row.base_threads = more ? speed_up->base_threads : 0;
  row.speed_up = more ? speed_up->speed_up : none;
  SetKey scene = set.key;
  scene.bodies = 0;
  scene.seed = scene.scene_hash = "";
  const ExponentRow* const exponent = find_row(tables.exponents, scene, ours.label);
  row.exponent = exponent == nullptr ? nan : exponent->law_of_many.exponent;
  row.worst_frame = worst_frame(ours, noise);
  return row;
}

std::optional<NarrowBestRow> narrow_best_of(const SampleSet& set, std::int64_t batch, Noise noise,
                                            const Tables& tables) {
  const auto is_rival = [&](const Contestant& contestant) {
    return contestant.batch == batch && is_right(set, contestant, tables.depth_error);
  };
  const auto fastest_of = [&](bool ours, bool right) {
    return fastest_or_first(set, noise, [&](const Contestant& contestant) {
      return contestant.batch == batch && (ours ? contestant.is_ours() : contestant.is_others()) &&
             (!right || is_rival(contestant));
    });
  };
  const Contestant* const ours = fastest_of(true, true);
  if (ours == nullptr) return std::nullopt;
  const bool unheard = is_any_unheard(set, *ours, noise, is_rival);
  const auto best = [&](const Contestant* contestant) {
    NarrowBestRow::Best found;
    if (contestant == nullptr) return found;
    found.label = contestant->label;
    if (const TimeRow* const time = find_row(tables.times, set.key, contestant->label)) {
      found.seconds = time->seconds.median;
    }
    if (const AgreementRow* const row = find_row(tables.agreement, set.key, contestant->label)) {
      found.queries = row->queries;
      found.wrong = row->wrong;
      found.failed = row->failed;
      found.worst_error = row->worst_error;
    }
    if (!unheard) found.ratio = ratio_between(set, *contestant, *ours, noise);
    return found;
  };
  return NarrowBestRow{.key = set.key,
                       .batch = batch,
                       .ours = best(ours),
                       .right_peer = best(fastest_of(false, true)),
                       .any_peer = best(fastest_of(false, false))};
}

}  // namespace

const Contestant* fastest(const SampleSet& set, Noise noise, const TakesPart& takes_part) {
  const Contestant* best = nullptr;
  double least = nan;
  for (const Contestant& contestant : set.contestants) {
    if (contestant.failure || !takes_part(contestant)) continue;
    const double ratio = median(paired_log_ratios(contestant, set.baseline(), noise));
    if (std::isnan(ratio) || ratio >= least) continue;
    least = ratio;
    best = &contestant;
  }
  return best;
}

bool is_any_unheard(const SampleSet& set, const Contestant& best, Noise noise,
                    const TakesPart& takes_part) {
  constexpr double most_noise = 3;
  std::vector<double> of_best;
  for (const auto& [square, seconds] : by_square(best, noise)) of_best.push_back(seconds);
  if (of_best.empty()) return true;
  const double far = most_noise * median(std::move(of_best));
  return std::ranges::any_of(set.contestants, [&](const Contestant& contestant) {
    const auto may_be_fast = [&](const Sample& sample) {
      return !(sample.seconds() / sample.units > far);
    };
    return by_square(contestant, noise).empty() &&
           std::ranges::any_of(contestant.samples, may_be_fast) && takes_part(contestant);
  });
}

std::set<std::int64_t> batches_of(const SampleSet& set) {
  std::set<std::int64_t> batches;
  for (const Contestant& contestant : set.contestants) batches.insert(contestant.batch);
  return batches;
}

std::vector<BroadBestRow> broad_best(const Results& results, Noise noise, const Tables& tables) {
  std::vector<BroadBestRow> rows;
  for (const SampleSet& set : results.sets) {
    if (set.key.narrow()) continue;
    const Contestant* const ours = fastest_or_first(set, noise, [&](const Contestant& contestant) {
      return contestant.is_ours() && is_right(set, contestant, tables.depth_error);
    });
    if (ours != nullptr) rows.push_back(broad_best_of(set, *ours, noise, tables));
  }
  return rows;
}

std::vector<NarrowBestRow> narrow_best(const Results& results, Noise noise, const Tables& tables) {
  std::vector<NarrowBestRow> rows;
  for (const SampleSet& set : results.sets) {
    if (!set.key.narrow()) continue;
    for (const std::int64_t batch : batches_of(set)) {
      if (auto row = narrow_best_of(set, batch, noise, tables)) rows.push_back(*std::move(row));
    }
  }
  return rows;
}

}  // namespace touchstone::stats
