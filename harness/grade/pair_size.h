// The size of a pair.
#pragma once

#include "harness/files/cases.h"

namespace touchstone::grade {

// What tolerances are relative to, in metres: the greatest extent of the two bounded bodies, each
// along its own axes (the longest side of a box, the diameter of a sphere, the longest side of the
// box around a hull's vertices, whatever the poses). Half-spaces do not count; 0 where nothing has
// an extent.
double pair_size(const files::Case& c);

// The same for one shape.
double shape_size(const Shape& shape);

}  // namespace touchstone::grade
