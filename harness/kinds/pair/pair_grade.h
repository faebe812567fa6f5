// The grade of an answer about a pair of convex bodies, in the words of all kinds.
#pragma once

#include "harness/grade/graded_answer.h"
#include "harness/kinds/grade.h"

namespace touchstone::kinds {

// Grades against what the algorithm was given, by grade::class_of, so the side of contact has no margin. `extreme`
// belongs to the regime (margins.h). An approximate algorithm that calls bodies overlapping that are apart is `near`;
// a depth that is labelled as a bound and is too great is `bound`.
Graded grade_pair(const NarrowPhaseEntry& entry, const grade::GradedAnswer& answer, bool extreme);

}  // namespace touchstone::kinds
