// What the batches of all kinds share, and what kinds without batches have instead.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "algorithms/core/status.h"
#include "harness/families/draws.h"
#include "harness/kinds/kind.h"
#include "harness/kinds/selection.h"
#include "harness/process/isolate.h"

namespace touchstone::kinds {

// The draws of one case: different for each family, seed and index.
inline families::RandomDraws draws_of(const Kind& kind, std::uint32_t number, std::uint64_t seed,
                                      std::uint64_t index) {
  const std::uint64_t family = std::uint64_t{kind.draw_number()} * 1000 + number;
  return families::RandomDraws(base::mix(seed) + family, index);
}

template <class Entry>
Contestant contestant_of(const Kind& kind, const Entry& entry, bool promised,
                         Precision scalar = Precision::float64, std::uint8_t task = 0) {
  return {.kind = &kind,
          .info = &entry.info,
          .entry = &entry,
          .scalar = scalar,
          .task = task,
          .promised = promised && entry.info.origin == Origin::ours};
}

template <class Entry>
std::vector<const AlgorithmInfo*> infos_of(std::span<const Entry> entries) {
  std::vector<const AlgorithmInfo*> infos;
  for (const Entry& entry : entries) infos.push_back(&entry.info);
  return infos;
}

// The algorithms of these names that offer a scalar and a task, in the order of the entries. The oracle belongs
// to no group. `offers(entry, scalar, task)`; `promises(entry)` of ours: what it does not give up is right.
template <class Entry, class Offers, class Promises>
std::vector<Contestant> contestants_of(const Kind& kind, std::span<const Entry> entries,
                                       const std::vector<std::string>& names,
                                       std::span<const Precision> scalars, const Offers& offers,
                                       const Promises& promises) {
  std::vector<Contestant> all;
  for (const Entry* entry : select(entries, names, kind.contract())) {
    const bool is_named = std::ranges::find(names, entry->info.name) != names.end();
    if (entry->info.origin == Origin::oracle && !is_named) continue;
    for (const Precision scalar : scalars) {
      for (std::uint8_t task = 0; task < kind.tasks().size(); ++task) {
        if (!offers(*entry, scalar, task)) continue;
        all.push_back(contestant_of(kind, *entry, promises(*entry), scalar, task));
      }
    }
  }
  return all;
}

// The grade that the status alone decides, if it does.
inline std::optional<Grade> grade_of_status(Status status, bool is_unknown) {
  if (process::is_lost(status)) return Grade::failed;
  if (status == Status::unsupported) return Grade::not_asked;
  if (!is_meant(status) || is_unknown) return Grade::gave_up;
  return std::nullopt;
}

// The grade of a verdict that is not what the exact one is.
inline std::optional<Grade> grade_of_verdict(bool contact, bool truth) {
  if (contact == truth) return std::nullopt;
  return truth ? Grade::missed : Grade::false_hit;
}

// An algorithm may lose so many queries of a job, since each hang costs a time limit.
inline process::IsolationLimits batch_limits(double time_limit) {
  return {.item_seconds = time_limit, .failures = 20};
}

// The places of the cases that a form is asked for: every fifth, or all as they are drawn.
inline bool is_asked(CaseForm form, std::uint64_t index) {
  return form == CaseForm::as_drawn || index % 5 == 0;
}

// Kinds that have no families and no timed sets, and are asked with a user's own file alone.
class AskedOnly : public Kind {
 public:
  using Kind::Kind;

  std::vector<Contestant> contestants(const std::vector<std::string>& /*names*/,
                                      std::span<const Precision> /*scalars*/) const final {
    throw std::logic_error("a kind without families has no contestants");
  }
  std::unique_ptr<Batch> draw(const Family& /*family*/, const BatchRange& /*range*/) const final {
    throw std::logic_error("a kind without families draws nothing");
  }
  std::vector<PlannedSet> timed_sets(files::TomlTable& table,
                                     const std::filesystem::path& /*home*/) const final {
    table.fail("kind", "these have no timed sets of this form");
  }

 private:
  std::vector<Family> list_families() const final { return {}; }
};

}  // namespace touchstone::kinds
