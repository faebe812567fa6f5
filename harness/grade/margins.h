// The margins of the project: the errors that an answer may have before it counts as wrong.
//
// Documented margins. An answer of ours may be wrong within them, and not beyond them. `check` applies
// them, also along axes.
//
//                                      double                float
//                              unit scale  extreme   unit scale  extreme
//   side of contact, bounds       1e-12     1e-9        1e-5       1e-4
//   distance, depth               1e-9      1e-9        1e-4       1e-4
//   bounds of `touching` apart    6e-14     6e-14       4e-5       4e-5
//   witness points, off the body  1e-4      1e-4        1e-4       1e-4
//
// Each is a part of the pair's scale, and holds end to end: against the pair of the case. The scale
// is the greatest of the pair's size (pair_size), its distance and, for points away from their own
// origin and for half-spaces, a thousandth of those coordinates, since a distance is a difference
// of them. A depth that is labelled as a bound may be too great, but never too small; the
// translation that it states separates the bodies. An approximate algorithm may report separate
// bodies as overlapping, but not the reverse.
//
// Grazing band. `run` applies it, since it compares libraries of any design: within it an answer on
// the other side of contact is counted apart and is no disagreement.
//
//                                      double                float
//   side of contact                1e-6 of the size     1e-4 of the size
//   and the rounding of coordinates, 8 epsilon of the greatest
#pragma once

#include "algorithms/core/outcome.h"
#include "harness/files/cases.h"

namespace touchstone::grade {

// Returns the greatest extent of the two bounded bodies, each along its own axes, whatever the
// poses: the longest side of a box, the diameter of a sphere, the longest side of the box around a
// hull's vertices. Half-spaces do not count. Returns 0 if nothing has an extent.
double pair_size(const files::Case& c);

// Returns the size of one shape, by the rule of pair_size.
double shape_size(const Shape& shape);

// The greatest error of a distance or depth that counts as right, as a part of the pair's size.
inline constexpr double usual_depth_error = 1e-3;

struct Margins {
  double verdict;     // side of contact, certified bounds
  double length;      // distance, depth
  double resolution;  // width of the bounds of `touching`
  double witness = 1e-4;
};

Margins documented_margins(Precision scalar, bool extreme);

// Returns the width of the grazing band, metres. `size` and `reach` (greatest coordinate) are
// metres.
double grazing_band(double size, double reach, Precision scalar);

}  // namespace touchstone::grade
