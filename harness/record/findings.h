// What a campaign found: everything that the tables and the exit status are made from.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "harness/record/raw_row.h"

namespace touchstone {

// A departure of one algorithm from what it should have found, on one frame or window.
struct Departure {
  std::int64_t block = 0;
  std::int64_t row = -1;  // of raw.csv, from 0; -1: not added yet
  std::string algorithm;
  bool ours = false;
  bool known = false;  // the registry names it as a known defect, or the algorithm as approximate
  std::string where;   // scene, bodies, frame, and pair kind
  std::string what;    // in words
  std::string reproduction;  // the file that shows it; empty where none was written
};

class Findings {
 public:
  void add(RawRow row) { rows_.push_back(std::move(row)); }
  // What the row that was added last tells of, unless it names another; the same is told once.
  void add(Departure departure);

  const std::vector<RawRow>& rows() const { return rows_; }
  const std::vector<Departure>& departures() const { return departures_; }

  // True when one of our own algorithms departed in a way that is not known and accepted.
  bool ours_are_wrong() const;

 private:
  std::vector<RawRow> rows_;
  std::vector<Departure> departures_;
};

// departures.csv
std::vector<std::string> departure_header();
void write(CsvWriter& file, const Departure& departure);
std::vector<Departure> read_departures(const std::filesystem::path& file);

}  // namespace touchstone
