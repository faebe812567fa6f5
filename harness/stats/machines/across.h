// Results whose blocks were measured on several machines. A ratio holds within a machine only, so
// each machine has tables of its own, and what is said of all of them is the range of their ratios.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "harness/stats/key_columns.h"
#include "harness/stats/tables/tables.h"

namespace touchstone::stats {

// A contestant's ratio to the baseline in one cell, over the machines. A cell is a set without its
// seed.
struct AcrossRow {
  SetKey key;  // seed and scene_hash empty
  std::string label, baseline;
  std::int64_t machines = 0;
  double least = 0, greatest = 0;  // of the medians
  double low = 0, high = 0;        // the ends of all intervals; NaN if there is none
};

// across.csv
template <record::row_of<AcrossRow> Row, class Visit>
void columns(Row& row, Visit visit) {
  key_columns(row.key, visit);
  visit("algorithm", row.label, "The algorithm's label.");
  visit("baseline", row.baseline, "The algorithm that its time is compared with.");
  visit("machines", row.machines, "Number of machines that measured the cell.");
  visit("least", row.least, "Least ratio of a machine: its time over the baseline's.");
  visit("greatest", row.greatest, "Greatest ratio of a machine.");
  visit("low", row.low, "Lowest end of a machine's 95 % interval; empty where none has one.");
  visit("high", row.high, "Highest end of a machine's 95 % interval.");
}

// Returns a row for each cell and contestant that at least two machines measured, from their tables.
std::vector<AcrossRow> across_machines(const std::vector<Tables>& of_machines);
// Returns them as Markdown.
std::string across_markdown(const std::vector<AcrossRow>& rows);

}  // namespace touchstone::stats
