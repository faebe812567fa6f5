// The table of narrow phases, with speed and error: the best of ours against the others.
#include <cmath>

#include "harness/stats/tables/fastest.h"
#include "harness/stats/tables/table_parts.h"

namespace touchstone::stats {

std::vector<NarrowBestRow> narrow_best(const Results& results, Noise noise, const Tables& tables) {
  std::vector<NarrowBestRow> rows;
  for (const SampleSet& set : results.sets) {
    if (!set.key.narrow()) continue;
    const auto agreement = [&](const Contestant& contestant) {
      return find_row(tables.agreement, set.key, contestant.label);
    };
    const auto is_right = [&](const Contestant& contestant) {
      const AgreementRow* const row = agreement(contestant);
      return row != nullptr && row->wrong == 0 && !(row->worst_error > tables.depth_error);
    };
    const Contestant* const ours = fastest(set, noise, [&](const Contestant& contestant) {
      return contestant.is_ours() && is_right(contestant);
    });
    if (ours == nullptr) continue;
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
    NarrowBestRow& row = rows.emplace_back();
    row.key = set.key;
    row.ours = best(ours);
    row.right_peer = best(fastest(set, noise, [&](const Contestant& contestant) {
      return !contestant.is_ours() && is_right(contestant);
    }));
    row.any_peer = best(
        fastest(set, noise, [&](const Contestant& contestant) { return !contestant.is_ours(); }));
  }
  return rows;
}

}  // namespace touchstone::stats
