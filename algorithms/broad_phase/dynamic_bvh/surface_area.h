// Part of dynamic-bvh: the surface area of a box and the union of two, by which Bvh16 chooses the
// child of an inserted body and finds subtrees to rebuild.
#pragma once

#include <algorithm>

#include "algorithms/core/aabb.h"

namespace touchstone {

// Half of the surface area (square metres), plus 1e-6 of the squared lengths, so that boxes that
// are points or lines have an order. No product of floats overflows a double.
inline double surface(double x, double y, double z) {
  return x * y + y * z + z * x + 1e-6 * (x * x + y * y + z * z);
}
// The surface of a box, which must not be empty.
inline double surface(const Aabb& box) {
  return surface(double{box.max[0]} - box.min[0], double{box.max[1]} - box.min[1],
                 double{box.max[2]} - box.min[2]);
}

inline Aabb united(const Aabb& a, const Aabb& b) {
  Aabb sum{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    sum.min[axis] = std::min(a.min[axis], b.min[axis]);
    sum.max[axis] = std::max(a.max[axis], b.max[axis]);
  }
  return sum;
}

}  // namespace touchstone
