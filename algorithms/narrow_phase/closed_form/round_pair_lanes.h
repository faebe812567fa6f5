// Part of closed-form: spheres and capsules with each other, or spheres with a box, cylinder or cone, one
// pair per lane of vectors. Includes core and kernels.
// Paper:   Ericson, "Real-Time Collision Detection", 2005, sections 5.1.3 (point and box), 5.1.9
//          (segments).
//
// A cylinder's or cone's outline in the half plane through a point and the axis is a rectangle or a
// triangle. The place of it that is nearest to the point is the nearest of the solid.
//
// The lanes solve pairs with sizes within 1e-10 to 1e12 metres and solids whose matrices are
// orthonormal up to rounding. They return all others, and those that they leave open, for a serial
// test.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/core/body_pairs.h"
#include "algorithms/core/outcome.h"
#include "algorithms/core/shape.h"

namespace touchstone {

template <class Scalar>
class RoundPairLanes {
 public:
  // Ignores ellipsoids, hulls and half-spaces.
  void bind(std::span<const Shape> shapes);

  static bool takes(ShapeKind kind_a, ShapeKind kind_b) {
    if (kind_a == ShapeKind::sphere) return kind_b <= ShapeKind::cone;
    return kind_a == ShapeKind::capsule && kind_b == ShapeKind::capsule;
  }
  // Solves pairs of kinds that it takes. Writes outcomes, except for the pairs whose places it
  // writes to `left`, which must have room for all. Returns the number of those.
  std::size_t solve(ShapeKind kind_a, ShapeKind kind_b, const BodyPairs& pairs, Task task,
                    std::span<Outcome> outcomes, std::uint32_t* left) const;

 private:
  // Four numbers per shape, metres: the half extents of a box, else radius and half length (of a
  // sphere, zero).
  std::vector<Scalar> sizes_;
};

extern template class RoundPairLanes<float>;
extern template class RoundPairLanes<double>;

}  // namespace touchstone
