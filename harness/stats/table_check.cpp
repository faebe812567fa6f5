// Checks the ratios of a table, and published claims, against measured results.
#include "harness/stats/table_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/base/table.h"
#include "harness/files/csv.h"
#include "harness/files/packed_files.h"
#include "harness/files/text_file.h"
#include "harness/stats/comparison.h"
#include "harness/stats/tables/tables.h"

namespace touchstone::stats {

// The columns of ratios.csv and library_ratios.csv that state a cell.
template <record::row_of<CheckedCell> Row, class Visit>
void columns(Row& row, Visit visit) {
  key_columns(row.key, visit);
  visit("algorithm", row.label, "");
  visit("baseline", row.baseline, "");
  visit("canary", row.canary, "");
  visit("ratio", row.stated, "");
  visit("band_low", row.band_low, "");
  visit("band_high", row.band_high, "");
}

namespace {

// Returns the cells of the table, without those of the canaries.
std::vector<CheckedCell> read_bands(const std::filesystem::path& file) {
  std::vector<CheckedCell> cells;
  record::reader_of<CheckedCell>(file).read([&](const files::CsvReader::Row& fields) {
    auto cell = record::read_row<CheckedCell>(fields);
    if (cell.canary) return;
    if (cell.band_low > cell.band_high) {
      fields.fail("column band_low is above band_high; expected a band");
    }
    cells.push_back(std::move(cell));
  });
  return cells;
}

}  // namespace

std::string_view to_string(Holds holds) {
  switch (holds) {
    case Holds::pass: return "pass";
    case Holds::fail: return "FAIL";
    case Holds::differs: return "differs on this machine";
    case Holds::faster: return "faster";
    case Holds::undecided: return "undecided";
  }
  return "?";
}

Holds holds(const MedianInterval& ratio, double band_low, double band_high) {
  // Comparisons with a missing number (NaN) are false.
  if (ratio.low >= band_low && ratio.high <= band_high) return Holds::pass;
  if (ratio.low > band_high * machine_spread || ratio.high < band_low / machine_spread) {
    return Holds::fail;
  }
  if (ratio.low > band_high || ratio.high < band_low) return Holds::differs;
  return Holds::undecided;
}

TableCheck check_tables(const std::filesystem::path& reference, const Results& here, Noise noise) {
  const Results stated = read_results(reference);
  const ResultNames names = {"the reference", "these results"};
  TableCheck check;
  Missing gone = missing(stated, here, names);
  check.changed = std::move(gone.scenes);
  check.left_out = std::move(gone.cells);
  for (std::string& line : changed_answers(stated, here, Compared::answers_and_work, names)) {
    check.changed.push_back(std::move(line));
  }
  const std::filesystem::path bands = files::row_file(reference / "library_ratios.csv");
  for (CheckedCell& cell : read_bands(
           std::filesystem::exists(bands) ? bands : files::row_file(reference / "ratios.csv"))) {
    const SampleSet* const set = here.find(cell.key);
    const Contestant* const contestant = set == nullptr ? nullptr : set->find(cell.label);
    const Contestant* const baseline = set == nullptr ? nullptr : set->find(cell.baseline);
    cell.ratio = {nan, nan, nan, 0};
    if (contestant != nullptr && baseline != nullptr) {
      cell.ratio = ratio_between(*set, *contestant, *baseline, noise);
    }
    const SampleSet* const set_there = stated.find(cell.key);
    const bool suspect =
        (set != nullptr && set->suspect) || (set_there != nullptr && set_there->suspect);
    if (!suspect) cell.state = holds(cell.ratio, cell.band_low, cell.band_high);
    const bool is_below = (cell.state == Holds::fail || cell.state == Holds::differs) &&
                          cell.ratio.high < cell.band_low;
    if (is_below && contestant->is_ours() && baseline->origin == record::RowOrigin::peer) {
      cell.state = Holds::faster;
    }
    check.cells.push_back(std::move(cell));
  }
  return check;
}

namespace {

bool is_about(const PublishedClaim& claim, const SampleSet& set) {
  const auto same = [](const std::string& wanted, const std::string& value) {
    return wanted.empty() || wanted == value;
  };
  return same(claim.scene, set.key.scene) && same(claim.pair_kind, set.key.pair_kind) &&
         set.find(claim.algorithm) != nullptr &&
         (claim.than.empty() || set.find(claim.than) != nullptr);
}

PublishedRow iterations_row(const PublishedClaim& claim, const SampleSet& set) {
  double sum = 0, squares = 0, count = 0;
  for (const Check& check : set.find(claim.algorithm)->checks) {
    const std::int64_t iterations = check.count(Work::iterations);
    if (iterations < 0 || check.pair_count <= 0) continue;
    sum += static_cast<double>(iterations);
    squares += static_cast<double>(check.count(Work::iterations_squared));
    count += static_cast<double>(check.pair_count);
  }
  const double mean = sum / count;
  const double deviation = std::sqrt(std::max(squares / count - mean * mean, 0.0));
  const double comparable = mean - static_cast<double>(claim.uncounted);
  PublishedRow row{set.key, "iterations of " + claim.algorithm,
                   fmt::format("{:g} ± {:g}", claim.mean, claim.deviation), "not counted",
                   Holds::undecided};
  if (!(count > 0)) return row;
  row.here = fmt::format("{:.1f} ± {:.1f}", comparable, deviation);
  if (claim.uncounted > 0)
    row.here += fmt::format(" ({:.1f} with the {} uncounted)", mean, claim.uncounted);
  row.state = std::abs(comparable - claim.mean) <= claim.deviation ? Holds::pass : Holds::fail;
  return row;
}

PublishedRow faster_row(const PublishedClaim& claim, const SampleSet& set, Noise noise) {
  const MedianInterval ratio =
      ratio_between(set, *set.find(claim.algorithm), *set.find(claim.than), noise);
  PublishedRow row{set.key, fmt::format("{} is faster than {}", claim.algorithm, claim.than), "yes",
                   "too few quiet squares", Holds::undecided};
  if (std::isnan(ratio.low)) return row;
  row.here = fmt::format("takes {:.3g} ({:.3g} to {:.3g}) times as long", ratio.median, ratio.low,
                         ratio.high);
  if (ratio.high < 1) row.state = Holds::pass;
  if (ratio.low > 1) row.state = Holds::fail;
  return row;
}

PublishedRow suffices_row(const PublishedClaim& claim, const SampleSet& set) {
  std::int64_t compared = 0, wrong = 0;
  for (const Check& check : set.find(claim.algorithm)->checks) {
    compared += std::max<std::int64_t>(check.compared, 0);
    wrong += std::max<std::int64_t>(check.disagreements, 0);
  }
  PublishedRow row{set.key, claim.algorithm + " suffices", "yes", "nothing was compared",
                   Holds::undecided};
  if (compared == 0) return row;
  row.here = fmt::format("{} of {} pairs wrong ({:.2g} %)", wrong, compared,
                         100.0 * static_cast<double>(wrong) / static_cast<double>(compared));
  row.state = wrong == 0 ? Holds::pass : Holds::fail;
  return row;
}

}  // namespace

std::vector<PublishedRow> check_published(const Published& published, const Results& results,
                                          Noise noise) {
  std::vector<PublishedRow> rows;
  for (const PublishedClaim& claim : published.claims) {
    const std::size_t before = rows.size();
    for (const SampleSet& set : results.sets) {
      if (!is_about(claim, set)) continue;
      switch (claim.kind) {
        case PublishedClaim::Kind::iterations: rows.push_back(iterations_row(claim, set)); break;
        case PublishedClaim::Kind::faster: rows.push_back(faster_row(claim, set, noise)); break;
        case PublishedClaim::Kind::suffices: rows.push_back(suffices_row(claim, set)); break;
      }
    }
    if (rows.size() > before) continue;
    SetKey nowhere;
    nowhere.scene = claim.scene;
    nowhere.pair_kind = claim.pair_kind;
    rows.push_back({nowhere, claim.algorithm, "", "was not run", Holds::undecided});
  }
  return rows;
}

std::string published_text(const Published& published, const std::vector<PublishedRow>& rows) {
  std::string text = fmt::format("Published: {}\n\n", published.source);
  if (!published.note.empty()) text += published.note + "\n\n";
  base::Table table({"", "input", "published", "here", ""}, 2);
  for (const PublishedRow& row : rows) {
    table.add(
        {row.claim, row.key.words(), row.published, row.here, std::string(to_string(row.state))});
  }
  return text + table.markdown();
}

void write_published(const Published& published, const std::vector<PublishedRow>& rows,
                     const std::filesystem::path& folder) {
  record::write_rows(folder / "published.csv", rows);
  files::write_text(folder / "published.md", published_text(published, rows));
}

}  // namespace touchstone::stats
