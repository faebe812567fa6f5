// Checks the ratios of a table against other results.
#include "harness/stats/table_check.h"

#include "harness/files/csv.h"
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
  const std::filesystem::path bands = reference / "library_ratios.csv";
  for (CheckedCell& cell :
       read_bands(std::filesystem::exists(bands) ? bands : reference / "ratios.csv")) {
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

}  // namespace touchstone::stats
