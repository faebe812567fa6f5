// The margins of the project: how far off an answer may be before it counts as wrong.
//
// Documented margins. Within them an answer of ours may be wrong, beyond them it may not. They hold
// `check` and `stress`.
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
//
// Grazing band. It holds `run`, which compares libraries of any design: within it an answer on the
// other side of contact is counted apart and is no disagreement.
//
//                                      double                float
//   side of contact                1e-6 of the size     1e-4 of the size
//   and the rounding of coordinates, 8 epsilon of the greatest
#pragma once

#include "algorithms/core/outcome.h"

namespace touchstone::grade {

struct Margins {
  double verdict;  // and certified bounds
  double length;   // distance, depth
};

Margins documented_margins(Precision scalar, bool extreme);

// The width of the grazing band, metres, of a pair of this size and greatest coordinate, metres.
double grazing_band(double size, double reach, Precision scalar);

}  // namespace touchstone::grade
