// The table of narrow phases, with speed and error: the best of ours against the others.
#include <cmath>
#include <optional>
#include <utility>

#include "harness/stats/tables/fastest.h"
#include "harness/stats/tables/table_parts.h"

namespace touchstone::stats {

namespace {

std::optional<NarrowBestRow> narrow_best_of(const SampleSet& set, std::int64_t batch, Noise noise,
                                            const Tables& tables) {
  const auto agreement = [&](const Contestant& contestant) {
    return find_row(tables.agreement, set.key, contestant.label);
  };
  const auto is_right = [&](const Contestant& contestant) {
    const AgreementRow* const row = agreement(contestant);
    return row != nullptr && row->wrong == 0 && !(row->worst_error > tables.depth_error);
  };
  const auto fastest_of = [&](bool ours, bool right) {
    return fastest(set, noise, [&](const Contestant& contestant) {
      return contestant.batch == batch && contestant.is_ours() == ours &&
             (!right || is_right(contestant));
    });
  };
  const Contestant* const ours = fastest_of(true, true);
  if (ours == nullptr) return std::nullopt;
  const auto best = [&](const Contestant* contestant) {
    NarrowBestRow::Best found;
    if (contestant == nullptr) return found;
    found.label = contestant->label;
    if (const TimeRow* const time = find_row(tables.times, set.key, contestant->label)) {
      found.seconds = time->seconds.median;
    }
    if (const AgreementRow* const row = agreement(*contestant)) {
      found.queries = row->queries;
      found.wrong = row->wrong;
      found.failed = row->failed;
      found.worst_error = row->worst_error;
    }
    found.ratio = ratio_between(set, *contestant, *ours, noise).ratio;
    return found;
  };
  return NarrowBestRow{.key = set.key,
                       .batch = batch,
                       .ours = best(ours),
                       .right_peer = best(fastest_of(false, true)),
                       .any_peer = best(fastest_of(false, false))};
}

}  // namespace

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
