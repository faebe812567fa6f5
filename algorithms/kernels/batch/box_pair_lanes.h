// The separating-axis test of two boxes, with one pair in each lane of vectors. Used by
// closed-form and clipped-faces.
// Paper: Gottschalk, Lin, Manocha, "OBBTree", SIGGRAPH 1996.
//
// The lanes handle pairs whose matrices are orthonormal up to rounding and whose sizes are within
// 1e-10 to 1e12 metres. All other pairs, and those whose sign or witness points the lanes leave
// open, are returned for a slower test.
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
class BoxPairLanes {
 public:
  // Reads the boxes among the shapes; other shapes are ignored.
  void bind(std::span<const Shape> shapes);

  // Solves Task::intersect or Task::penetration. Writes the outcomes of all pairs but those whose
  // places it writes to `left`, which has room for all; returns their number.
  std::size_t solve(const BodyPairs& pairs, Task task, std::span<Outcome> outcomes,
                    std::uint32_t* left) const;

 private:
  std::vector<Scalar> halves_;  // four numbers a shape: half extents (metres) and zero
};

extern template class BoxPairLanes<float>;
extern template class BoxPairLanes<double>;

}  // namespace touchstone
