// Results whose blocks were measured on several machines. A ratio holds within a machine only, so
// each machine has tables of its own, and what is said of all of them is the range of their ratios.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

#include "harness/stats/samples.h"
#include "harness/stats/summary.h"

namespace touchstone::stats {

// A row of blocks.csv, which stands beside a raw.csv of several shards.
struct BlockRow {
  std::int64_t block = 0, shard = 0;
  std::string machine;
  std::int64_t rows = 0;
};

template <record::row_of<BlockRow> Row, class Visit>
void columns(Row& row, Visit visit) {
  visit("block", row.block, "Number of the block in the campaign.");
  visit("shard", row.shard, "The shard that it was in.");
  visit("machine", row.machine,
        "The machine that measured it; `machines/` has its facts, and its tables where there are "
        "several.");
  visit("rows", row.rows, "Number of its rows in raw.csv.");
}

// Returns the machine of each block, as blocks.csv of the folder says; empty if it has no such file.
std::map<std::int64_t, std::string> machines_of_blocks(const std::filesystem::path& folder);

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

// Writes the tables of each machine into FOLDER/machines/NAME (see write_tables), and across.csv and
// across.md into the folder. Returns a text for the terminal. Throws InputError if a file cannot be
// written.
std::string write_machine_tables(const std::map<std::string, Results>& of_machines,
                                 const ReportSetting& setting, double band,
                                 const std::filesystem::path& folder);

}  // namespace touchstone::stats
