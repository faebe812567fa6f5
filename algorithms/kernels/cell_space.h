// Cells over a scene: where they lie and how large they are to be, whatever the boxes are like.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "algorithms/core/aabb.h"

namespace touchstone {

// What a sample of the boxes says of all of them. A few boxes that are huge or far away hardly
// change it, so that they cannot make the cells useless for the others.
struct BoxSample {
  std::array<double, 3> low{}, high{};  // the region where most of the boxes are
  double smallest_side = 0;             // of the sample; a box's side is its longest
  double usual_side = 0;                // nine in ten are no longer

  double extent() const;  // of the region, on its longest axis
};

// `ids`: the boxes that are not empty.
BoxSample sample_boxes(std::span<const Aabb> boxes, std::span<const std::uint32_t> ids);

inline double longest_side(const Aabb& box) {
  double side = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double length = double{box.max[axis]} - box.min[axis];
    side = length > side ? length : side;
  }
  return side;
}

// Cells of one size in rows along each axis. What lies beyond the first or the last cell belongs to
// that cell. In double, since differences of floats overflow; and x <= y gives cell(x) <= cell(y),
// rounding or not, which is all that the algorithms build on.
struct CellSpace {
  std::array<double, 3> origin{};
  double inverse_side = 1;
  std::array<std::uint32_t, 3> last{};  // the greatest cell number on each axis

  std::uint32_t cell(double x, std::size_t axis) const {
    const double place = (x - origin[axis]) * inverse_side;
    if (!(place > 0)) return 0;
    return place < last[axis] ? static_cast<std::uint32_t>(place) : last[axis];
  }
};

}  // namespace touchstone
