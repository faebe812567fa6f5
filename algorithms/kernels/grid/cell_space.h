// Uniform cells over a scene: their origin and their size, chosen from a sample of the boxes. Used
// by the grid and octree broad phases.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "algorithms/core/aabb.h"

namespace touchstone {

// Cells of one size in rows along each axis. Points beyond the first or the last cell belong to
// that cell. Coordinates are doubles, because differences of floats overflow. Rounding keeps the
// order: x <= y implies cell(x) <= cell(y), and the algorithms rely on this.
struct CellSpace {
  std::array<double, 3> origin{};
  std::array<double, 3> inverse_side{1, 1, 1};
  std::array<std::uint32_t, 3> last{};  // the greatest cell number on each axis

  std::uint32_t cell(double x, std::size_t axis) const {
    const double place = (x - origin[axis]) * inverse_side[axis];
    if (!(place > 0)) return 0;
    return place < last[axis] ? static_cast<std::uint32_t>(place) : last[axis];
  }
  // Returns the box's greatest extent over the three axes, in cells.
  double size(const Aabb& box) const {
    double size = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      size = std::max(size, (double{box.max[axis]} - box.min[axis]) * inverse_side[axis]);
    }
    return size;
  }
};

// Returns the box of the points in a cell. Outermost cells have no end; they reach to the ends of
// the region, which contains all bodies, or to their full size if that is more.
Aabb box_of_cell(const CellSpace& space, const std::array<std::uint32_t, 3>& cell,
                 const Aabb& region);

// Estimates for all boxes from a sample of them. The quantiles keep a few huge or distant boxes
// from making the cells useless for the others.
struct BoxSample {
  // The region that holds most of the boxes (metres).
  std::array<double, 3> low{}, high{};
  // A length for each axis that nine boxes in ten do not exceed (metres): the proportions of a cell
  // that suits them. An axis without extent gets the greatest length of the others, the region's
  // extent or 1, so no side is zero.
  std::array<double, 3> side{1, 1, 1};
  // Sizes of boxes in cells of these sides: the least of the sample, and the size that nine boxes
  // in ten do not exceed.
  double smallest = 0, usual = 0;

  // The region's greatest extent over the three axes, in cells of these sides.
  double extent() const;
};

// Sides to measure extents in. Each is at least a thousandth of the longest, so that rounding does
// not decide on an axis on which the boxes are flat; where all are zero, each is 1.
inline std::array<double, 3> with_floor(std::array<double, 3> sides) {
  const double least = 1e-3 * std::max({sides[0], sides[1], sides[2]});
  for (double& side : sides) side = least > 0 ? std::max(side, least) : 1;
  return sides;
}

// `ids` lists the boxes that are not empty.
BoxSample sample_boxes(std::span<const Aabb> boxes, std::span<const std::uint32_t> ids);

// The density around a body, relative to bodies spread evenly over the sample's region. It is
// estimated from how often two bodies of a larger sample lie in the same of 32^3 cells (8^3 for few
// bodies). The result is at least 1 and at most the number of cells.
double clustering_of(std::span<const Aabb> boxes, std::span<const std::uint32_t> ids,
                     const BoxSample& sample);

}  // namespace touchstone
