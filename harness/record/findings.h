// The findings of a campaign: the rows and departures from which tables and exit status follow.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "harness/record/raw_row.h"
#include "harness/record/row.h"

namespace touchstone::record {

// A departure: one algorithm's result on one frame or window is not the expected one.
struct Departure {
  std::int64_t block = 0;
  std::int64_t row = -1;  // index into raw.csv, from 0; -1: not added yet
  std::string algorithm;
  bool ours = false;         // of ours, or of a module (is_answerable)
  bool known = false;        // a known defect in the registry, or approximate by design
  std::string where;         // scene, bodies, frame, and pair kind
  std::string what;          // a sentence about the difference
  std::string reproduction;  // the file that reproduces it; empty if there is none
};

// Returns true if one of them is of an algorithm of ours or of a module, and not known and accepted.
bool ours_are_wrong(std::span<const Departure> departures);

class Findings {
 public:
  void add(RawRow row) { rows_.push_back(std::move(row)); }
  // Adds a departure of the row that was added last, unless it names another; duplicates are
  // ignored.
  void add(Departure departure);

  const std::vector<RawRow>& rows() const { return rows_; }
  const std::vector<Departure>& departures() const { return departures_; }

  bool ours_are_wrong() const { return record::ours_are_wrong(departures_); }

 private:
  std::vector<RawRow> rows_;
  std::vector<Departure> departures_;
};

// Returns a paragraph for each algorithm: its first departure and the file that reproduces it.
// The text is empty if there is no departure.
std::string departures_text(const Findings& findings);

// A row of departures.csv.
template <row_of<Departure> Row, class Visit>
void columns(Row& row, Visit visit) {
  visit("block", row.block, "Number of the block in the campaign.");
  visit("row", with_sign(row.row), "Place in raw.csv, from 0, of the row that shows it.");
  visit("algorithm", row.algorithm, "The algorithm's label, as in the tables.");
  visit("ours", row.ours,
        "1 for an algorithm of ours, or of a module: it ends the run with status 1 unless it is "
        "known.");
  visit("known", row.known, "1 where the departure is a known defect, or approximate by design.");
  visit("where", row.where, "Scene, bodies, frame and pair kind.");
  visit("what", row.what, "The departure in words.");
  visit("reproduction", row.reproduction,
        "The file that shows it again; empty where there is none.");
}

}  // namespace touchstone::record
