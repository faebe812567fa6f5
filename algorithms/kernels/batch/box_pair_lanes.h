// The separating-axis test of two boxes, one pair a lane of vectors.
// Paper: Gottschalk, Lin, Manocha, "OBBTree", SIGGRAPH 1996.
//
// Lanes are for pairs whose matrices are orthonormal up to rounding and whose sizes are within
// 1e-10 to 1e12 metres. Those, and all whose sign or witness points the lanes leave open, are
// handed back for a test that takes its time.
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
  // What is not a box is left out.
  void bind(std::span<const Shape> shapes);

  // Answers into outcomes, all but the pairs whose places are written to `left`, which has room for
  // all of them; how many those are. Intersect or penetration.
  std::size_t solve(const BodyPairs& pairs, Task task, std::span<Outcome> outcomes,
                    std::uint32_t* left) const;

 private:
  std::vector<Scalar> halves_;  // four a shape: half extents (metres) and zero
};

extern template class BoxPairLanes<float>;
extern template class BoxPairLanes<double>;

}  // namespace touchstone
