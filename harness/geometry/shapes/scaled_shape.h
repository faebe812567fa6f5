// Shapes of another size.
#pragma once

#include "algorithms/core/shape.h"

namespace touchstone::geometry {

// The shape with all lengths times the factor (> 0), about its body's origin. A hull's faces are found
// anew, as its vertices are rounded.
Shape scaled_shape(Shape shape, double factor);

}  // namespace touchstone::geometry
