// The documented margins: within them an answer of ours may be wrong, beyond them it may not.
//
//                                      double                float
//                              unit scale  extreme   unit scale  extreme
//   side of contact, bounds       1e-12     1e-9        1e-5       1e-4
//   distance, depth               1e-9      1e-9        1e-4       1e-4
//
// Each is a part of the pair's scale, and holds end to end: against the pair as the case has it.
// The scale is the size of the pair (pair_size), or its distance where that is greater; of points
// away from their own origin, and of half-spaces, a thousandth of those coordinates where that is
// greater still, since a distance is a difference of them. A depth that is labelled as a bound may
// be too great, and never too small; the translation that it states separates the bodies. An
// approximate algorithm may call bodies overlapping that are apart, and never the reverse.
#pragma once

#include <string>

#include "harness/check/graded_answer.h"

namespace touchstone {

struct Margins {
  double verdict;  // and certified bounds
  double length;   // distance, depth
};

Margins documented_margins(Precision scalar, bool extreme);

// What of an answer is beyond the margins of its algorithm, in words; empty where nothing is.
std::string beyond_margins(const NarrowPhaseEntry& entry, const GradedAnswer& answer, bool extreme);

}  // namespace touchstone
