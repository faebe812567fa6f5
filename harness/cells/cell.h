// A batch of queries of one make, and the algorithms that answer it.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "algorithms/algorithm_info.h"
#include "algorithms/core/outcome.h"

namespace touchstone::cells {

// What was wrong with an algorithm's answers to a cell. Counts are of queries.
struct Grade {
  std::int64_t missed = 0;       // says no where the exact answer is yes, and says that it is sure
  std::int64_t false_hits = 0;   // says yes where the exact answer is no
  std::int64_t other = 0;        // another number, triangle or time than the exact one
  std::int64_t unknown = 0;      // gave up, and said so
  double error = Outcome::none;  // the greatest error of a number, in the unit of the contract
  std::int64_t hits = -1;        // pairs that were found to touch; -1: not counted
  std::int64_t true_hits = -1;   // pairs that do
  std::uint64_t hit_hash = 0;    // of the pairs that were found, where they are counted
};

struct Contestant {
  std::string name;  // the algorithm's, and the scalar's where it offers several
  Origin origin = Origin::ours;
  bool approximate = false;  // its errors are known, and are no fault
  bool tolerant = false;     // it may say yes where the exact answer is no, within a tolerance
  // Readies it, untimed, once in each process and before the first answer there; may be null.
  std::function<void()> prepare = {};
  std::function<void()> answer;  // answers all queries; this is timed
  std::function<Grade()> grade;  // judges the last answers
};

// An algorithm that does not take all of a cell's queries.
struct LeftOut {
  std::string name;
  Origin origin;
};

// The contestants refer to the queries, which they keep alive.
struct Cell {
  std::int64_t queries = 0;
  std::int64_t graded = 0;  // the first so many are held against exact answers
  std::vector<Contestant> contestants;
  std::vector<LeftOut> left_out = {};
};

struct PlannedCell {
  std::string group, name;     // the group's cells are one table
  std::function<Cell()> make;  // the same cell each time
  // Its rounds are those of the cell before it, as where only threads differ, so that the ratio of both holds
  // whatever else the machine does meanwhile.
  bool joins_last = false;
};

}  // namespace touchstone::cells
