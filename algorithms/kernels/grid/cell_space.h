// Cells over a scene: where they lie and how large they are to be, whatever the boxes are like.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "algorithms/core/aabb.h"

namespace touchstone {

// Cells of one size in rows along each axis. What lies beyond the first or the last cell belongs to
// that cell. In double, since differences of floats overflow; and x <= y gives cell(x) <= cell(y),
// rounding or not, which is what the algorithms build on.
struct CellSpace {
  std::array<double, 3> origin{};
  std::array<double, 3> inverse_side{1, 1, 1};
  std::array<std::uint32_t, 3> last{};  // the greatest cell number on each axis

  std::uint32_t cell(double x, std::size_t axis) const {
    const double place = (x - origin[axis]) * inverse_side[axis];
    if (!(place > 0)) return 0;
    return place < last[axis] ? static_cast<std::uint32_t>(place) : last[axis];
  }
  // A box's size in cells, on the axis where it has the most.
  double size(const Aabb& box) const {
    double size = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      size = std::max(size, (double{box.max[axis]} - box.min[axis]) * inverse_side[axis]);
    }
    return size;
  }
};

// What a sample of the boxes says of all of them. A few boxes that are huge or far away hardly
// change it, so that they cannot make the cells useless for the others.
struct BoxSample {
  // The region where most of the boxes are.
  std::array<double, 3> low{}, high{};
  // On each axis, nine boxes in ten are no longer: a cell of these proportions suits them. Where
  // they have no length, that of another axis, or the region's extent, or 1: never zero.
  std::array<double, 3> side{1, 1, 1};
  // The boxes' sizes in cells of these sides: the least of the sample, and what nine in ten do not
  // exceed.
  double smallest = 0, usual = 0;

  // Of the region, in cells of these sides, on the axis where it has the most.
  double extent() const;
};

// `ids`: the boxes that are not empty.
BoxSample sample_boxes(std::span<const Aabb> boxes, std::span<const std::uint32_t> ids);

// How much denser it is around a body than it would be if all were spread evenly over the sample's
// region: by how often two bodies of a larger sample lie in one of 32^3 cells (8^3 for few bodies).
// At least 1, at most the number of cells.
double crowding(std::span<const Aabb> boxes, std::span<const std::uint32_t> ids,
                const BoxSample& sample);

}  // namespace touchstone
