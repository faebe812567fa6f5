// A failing query, with its case made as small as possible.
#pragma once

#include <string>

#include "harness/files/cases.h"
#include "harness/grade/graded_answer.h"

namespace touchstone::grade {

struct FailedQuery {
  const NarrowPhaseEntry* algorithm;
  bool extreme;       // trait of the regime, see margins.h
  double time_limit;  // seconds for one query
  files::Case original;
  GradedAnswer answer;  // the answer for the original
};

struct ShrunkFailure {
  GradedAnswer answer;  // the answer for the case in the line
  // A line of a case file: the case, and further keys, which readers of cases ignore, for the exact
  // answer and the fault.
  std::string line;

  template <class Visit>
  void for_each_field(Visit visit) {
    visit(answer);
    visit(line);
  }
};

// Shrinks the case while it still fails in the same way, for at most a second. This takes place in
// a child process, since a query on the way may kill it; in that event the case stays as it is.
ShrunkFailure shrunk_failure(const FailedQuery& failed);

}  // namespace touchstone::grade
