// Graded answers, counted.
#pragma once

#include <cstdint>

#include "harness/grade/graded_answer.h"

namespace touchstone::grade {

// Answers of one algorithm in one scalar, over all tasks. Errors are parts of the scale
// (GradedAnswer::scale), the greatest of each; NaN where there is none.
struct AnswerCount {
  std::int64_t answers = 0;       // supported pairs that were asked about
  std::int64_t not_reported = 0;  // with a status that says nothing
  std::int64_t silent = 0;        // wrong side of contact, against what was given
  std::int64_t silent_end = 0;    // wrong side of contact, against the case
  std::int64_t honest = 0;        // failures that the algorithm told of
  std::int64_t crashed = 0;
  std::int64_t timed_out = 0;
  std::int64_t touching = 0;          // of bodies that touch exactly, answered
  std::int64_t touching_contact = 0;  // ... as contact
  std::int64_t bounds = 0;            // certified bounds that miss the exact value
  std::int64_t not_a_number = 0;
  std::int64_t beyond = 0;         // ours: beyond the documented margins
  double honest_margin;            // greatest exact |signed distance| of an honest failure
  double margin, margin_end;       // greatest exact |signed distance| called wrongly
  double distance, distance_end;   // |error| of a gap
  double too_deep, too_shallow;    // errors of a depth, both >= 0, against what was given
  double depth_end;                // |error| of a depth, against the case
  double does_not_separate;        // by how far the reported translation does not
  double excess;                   // by how far it is more than is needed
  double bounds_missed;            // by how far, against the case
  double witness, witness_length;  // points off their bodies; |a - b| against the distance
  double normal;                   // | |n| - 1 |

  AnswerCount();
  void add(const GradedAnswer& answer);
  void add(const AnswerCount& other);
};

// Keeps the greater of the two; a number that is not known (NaN) does not count.
void keep_greater(double& worst, double value);

}  // namespace touchstone::grade
