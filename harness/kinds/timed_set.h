// A batch of queries of one make, and the algorithms that answer it.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "algorithms/algorithm_info.h"
#include "algorithms/core/outcome.h"
#include "harness/kinds/grade.h"

namespace touchstone::kinds {

// What an algorithm's answers to a timed set are worth. Counts are of queries.
struct TimedGrade : GradeCount {
  double error = Outcome::none;  // the greatest error of a number, in the unit of the contract
  std::int64_t hits = -1;        // pairs that were found to touch; -1: not counted
  std::int64_t true_hits = -1;   // pairs that do
  std::uint64_t hit_hash = 0;    // of the pairs that were found, where they are counted

  // The error is the greatest, or the first that is no number.
  void note_error(double of_query) {
    if (!(of_query <= error)) error = of_query;
  }
};

struct TimedContestant {
  std::string name;  // the algorithm's, and the scalar's where it offers several
  Origin origin = Origin::ours;
  bool approximate = false;  // its errors are known, and are no fault
  // Readies it, untimed, once in each process and before the first answer there; may be null.
  std::function<void()> prepare = {};
  std::function<void()> answer;       // answers all queries; this is timed
  std::function<TimedGrade()> grade;  // judges the last answers
  // Of the last answers: equal answers have equal hashes. It is not timed.
  std::function<std::uint64_t()> hash;
};

// An algorithm that does not take all queries of a set.
struct LeftOut {
  std::string name;
  Origin origin;
};

// The contestants refer to the queries, which they keep alive.
struct TimedSet {
  std::int64_t queries = 0;
  std::int64_t graded = 0;            // the first so many are held against the truth
  std::string_view truth = "oracle";  // who says what is right
  std::vector<TimedContestant> contestants;
  std::vector<LeftOut> left_out = {};
};

struct PlannedSet {
  std::string group, name;         // the group's sets are one table
  std::function<TimedSet()> make;  // the same set each time
  // Its rounds are those of the set before it, as where only threads differ, so that the ratio of both holds
  // whatever else the machine does meanwhile.
  bool joins_last = false;
  int threads = 1;  // that each contestant may use
};

}  // namespace touchstone::kinds
