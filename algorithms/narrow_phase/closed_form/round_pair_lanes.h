// Spheres and capsules, with each other or with a box, one pair a lane of vectors.
// Paper: Ericson, "Real-Time Collision Detection", 2005, sections 5.1.3 (point and box), 5.1.9
// (segments).
//
// Lanes are for sizes within 1e-10 to 1e12 metres and for boxes whose matrices are orthonormal up
// to rounding. Those, and all that the lanes leave open, are handed back for a test that takes its
// time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/core/outcome.h"
#include "algorithms/core/shape.h"
#include "algorithms/kernels/batch/body_pairs.h"

namespace touchstone {

template <class Scalar>
class RoundPairLanes {
 public:
  // What is no sphere, capsule or box is left out.
  void bind(std::span<const Shape> shapes);

  static bool takes(ShapeKind kind_a, ShapeKind kind_b) {
    return kind_a <= ShapeKind::capsule && kind_b <= ShapeKind::box &&
           !(kind_a == ShapeKind::capsule && kind_b == ShapeKind::box);
  }
  // Of kinds that it takes. Answers into outcomes, all but the pairs whose places are written to
  // `left`, which has room for all of them; how many those are.
  std::size_t solve(ShapeKind kind_a, ShapeKind kind_b, const BodyPairs& pairs, Task task,
                    std::span<Outcome> outcomes, std::uint32_t* left) const;

 private:
  // Four a shape, metres: of a box the half extents, else radius and half length.
  std::vector<Scalar> sizes_;
};

extern template class RoundPairLanes<float>;
extern template class RoundPairLanes<double>;

}  // namespace touchstone
