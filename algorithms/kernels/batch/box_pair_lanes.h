// The separating-axis test of two boxes, with one pair in each lane of vectors, and their distance.
// Used by closed-form and clipped-faces.
// Paper: Gottschalk, Lin, Manocha, "OBBTree", SIGGRAPH 1996.
//
// Boxes that rest on each other touch at a face: if its plane and two points, one of each box, bound
// the signed distance on both sides of zero within rounding, they are `touching`.
//
// The lanes handle pairs whose matrices are orthonormal up to rounding and whose sizes are within
// 1e-10 to 1e12 metres. All other pairs, and those whose sign or witness points the lanes leave
// open, are returned for a slower test.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>
#include <vector>

#include "algorithms/core/body_pairs.h"
#include "algorithms/core/outcome.h"
#include "algorithms/core/shape.h"

namespace touchstone {

// What rounding may do where faces meet, as parts of a pair's size: the sum of the half extents and of the offset's
// coordinates. `rest` bounds the rounding of a gap along a face's normal, whose extents are calculated from the
// matrices as they are, and that of the distance of two points: 8 u for fewer than nine operations in a row, each with
// a result that is no greater; in float 4 u more for the numbers that were rounded. Boxes touch if their gap is within
// `at_contact` and their bounds are no further apart than `widest`. Points that `room` does not part are next to each
// other. u is half an epsilon.
template <class Scalar>
struct RestError {
  static constexpr bool is_float = std::is_same_v<Scalar, float>;
  static constexpr Scalar u = std::numeric_limits<Scalar>::epsilon() / 2;
  static constexpr Scalar rest = (is_float ? 13 : 9) * u, at_contact = 8 * u;
  static constexpr Scalar room = 4 * u, widest = (is_float ? 48 : 40) * u;
};

template <class Scalar>
class BoxPairLanes {
 public:
  // Reads the boxes among the shapes; other shapes are ignored.
  void bind(std::span<const Shape> shapes);

  // Solves any task but Task::signed_distance. Writes the outcomes of all pairs but those whose
  // places it writes to `left`, which has room for all; returns their number.
  std::size_t solve(const BodyPairs& pairs, Task task, std::span<Outcome> outcomes,
                    std::uint32_t* left) const;

 private:
  std::vector<Scalar> halves_;  // four numbers a shape: half extents (metres) and zero
};

extern template class BoxPairLanes<float>;
extern template class BoxPairLanes<double>;

}  // namespace touchstone
