// What a campaign found: everything that the tables and the exit status are made from.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "harness/run/outcome_check.h"
#include "harness/run/pair_check.h"
#include "harness/run/raw_row.h"

namespace touchstone {

// A departure of one algorithm from what the others say, on one frame.
struct Departure {
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
  void add(Departure departure) { departures_.push_back(std::move(departure)); }

  // Outcomes of one narrow phase (its label: name and scalar) on one kind of pairs.
  void add(const std::string& narrow, Task task, const std::string& pair_kind,
           const OutcomeFaults& faults);

  // Remembers the fingerprint under a key that leaves out the number of threads; false when another
  // width gave another fingerprint.
  bool same_at_every_width(const std::string& key, const std::string& fingerprint);

  const std::vector<RawRow>& rows() const { return rows_; }
  const std::vector<Departure>& departures() const { return departures_; }
  using OutcomeKey = std::tuple<Task, std::string, std::string>;  // task, narrow, pair kind
  const std::map<OutcomeKey, OutcomeFaults>& outcomes() const { return outcomes_; }

  // True when one of our own algorithms departed in a way that is not known and accepted.
  bool ours_are_wrong() const;

 private:
  std::vector<RawRow> rows_;
  std::vector<Departure> departures_;
  std::map<OutcomeKey, OutcomeFaults> outcomes_;
  std::map<std::string, std::string> fingerprints_;
};

}  // namespace touchstone
