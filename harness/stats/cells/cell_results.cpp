// Reads the rows of a cell run.
#include "harness/stats/cells/cell_results.h"

#include <fmt/format.h>

#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include "harness/base/enumerators.h"
#include "harness/base/error.h"
#include "harness/files/row_file.h"
#include "harness/record/facts.h"
#include "harness/record/raw_row.h"
#include "harness/record/row.h"
#include "harness/stats/cells/cell_rows.h"
#include "harness/stats/cells/cell_times.h"

namespace touchstone::stats {
namespace {

std::filesystem::path folder_of(const std::filesystem::path& folder_or_file) {
  return std::filesystem::is_directory(folder_or_file) ? folder_or_file
                                                       : folder_or_file.parent_path();
}

template <class Enum>
std::optional<Enum> named(std::string_view name) {
  for (const Enum value : base::enumerators<Enum>)
    if (to_string(value) == name) return value;
  return std::nullopt;
}

Contestant contestant_of(const GradeRow& row) {
  Contestant contestant;
  contestant.label = row.algorithm;
  contestant.origin = named<record::RowOrigin>(row.origin);
  Check& check = contestant.checks.emplace_back();
  check.phase = record::Phase::narrow;
  check.grade = fmt::format("{} missed, {} false, {} inexact, {} gave up", row.missed,
                            row.false_hits, row.inexact, row.gave_up);
  if (row.hits >= 0) check.grade += fmt::format(", {} hits ({})", row.hits, row.hit_hash);
  check.status = named<record::RowStatus>(row.status).value_or(record::RowStatus::wrong);
  if (check.status != record::RowStatus::ok) contestant.failure = check.status;
  return contestant;
}

}  // namespace

bool is_of_cells(const std::filesystem::path& folder_or_file) {
  return std::filesystem::exists(files::row_file(folder_of(folder_or_file) / "set_grades.csv"));
}

Results read_cell_results(const std::filesystem::path& folder_or_file) {
  const std::filesystem::path folder = folder_of(folder_or_file);
  Results results;
  results.file = folder / "raw.csv";
  if (std::filesystem::exists(folder / "machine.csv")) {
    const record::Facts facts = record::read_facts(folder / "machine.csv");
    for (const auto& [name, value] : facts) results.machine[name] = value;
    results.campaign = record::value_of(facts, "cells");
    results.isa = {record::value_of(facts, "instructions_in_use")};
  }
  std::map<std::pair<std::string, std::string>, std::size_t> place;
  for (const GradeRow& row : record::read_rows<GradeRow>(folder / "set_grades.csv")) {
    if (row.status == "unsupported") continue;
    const auto [at, is_new] = place.emplace(std::pair(row.group, row.cell), results.sets.size());
    if (is_new) {
      SetKey& key = results.sets.emplace_back().key;
      key.scene = row.group + ", " + row.cell;
      key.scene_hash = results.machine["cells_hash"];
    }
    results.sets[at->second].contestants.push_back(contestant_of(row));
  }
  for (const record::RawRow& row : record::read_rows<record::RawRow>(results.file)) {
    const auto at = place.find({row.input, row.family});
    Contestant* contestant = nullptr;
    if (at != place.end()) {
      SampleSet& set = results.sets[at->second];
      for (Contestant& each : set.contestants)
        if (each.label == row.algorithm) contestant = &each;
      if (contestant != nullptr && row.is_twin()) contestant = &set.twin;
      if (row.noise.ends_with("canary")) set.suspect = true;
      if (!row.stop.empty()) set.stop = row.stop;
    }
    if (contestant == nullptr)
      throw base::InputError(results.file.string(), 0,
                             fmt::format("{} in {}, {} has samples and no grade in set_grades.csv",
                                         row.algorithm, row.input, row.family));
    add_sample(*contestant, row);
  }
  return results;
}

}  // namespace touchstone::stats
