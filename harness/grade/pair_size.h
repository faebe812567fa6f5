// The size of a pair, in metres: the unit of tolerances.
#pragma once

#include "harness/files/cases.h"

namespace touchstone::grade {

// Returns the greatest extent of the two bounded bodies, each along its own axes, whatever the
// poses: the longest side of a box, the diameter of a sphere, the longest side of the box around a
// hull's vertices. Half-spaces do not count. Returns 0 if nothing has an extent.
double pair_size(const files::Case& c);

// Returns the size of one shape, by the rule of pair_size.
double shape_size(const Shape& shape);

}  // namespace touchstone::grade
