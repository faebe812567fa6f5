// A wrong answer, asked again about a case that is as small as can be.
#pragma once

#include <string>

#include "harness/files/cases.h"
#include "harness/grade/graded_answer.h"

namespace touchstone::grade {

struct FailedQuery {
  const NarrowPhaseEntry* algorithm;
  bool extreme;       // of the regime, see margins.h
  double time_limit;  // seconds a query
  files::Case original;
  GradedAnswer answer;  // about the original
};

struct ShrunkFailure {
  GradedAnswer answer;  // about the case in the line
  // A line of a case file: the case, the exact answer and what is wrong, as keys that a reader of
  // cases passes over.
  std::string line;

  template <class Visit>
  void for_each_field(Visit visit) {
    visit(answer);
    visit(line);
  }
};

// Shrinks the case as far as it still fails in the same way, for at most a second, in a child
// process: a query that is tried on the way may kill it. Then the case stays as it is.
ShrunkFailure shrunk_failure(const FailedQuery& failed);

}  // namespace touchstone::grade
