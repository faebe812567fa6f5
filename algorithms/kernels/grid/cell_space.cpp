// The sample from which grids are chosen: quantiles of places and sizes, and the density.
#include "algorithms/kernels/grid/cell_space.h"

#include <algorithm>
#include <array>
#include <limits>

#include "algorithms/kernels/sorting/ordered_key.h"

namespace touchstone {
namespace {

constexpr std::size_t sample_size = 256;
constexpr float most = std::numeric_limits<float>::max();

// Returns the least float in this cell or a later one, or the greatest float. It is looked for,
// since the inverse of the rounded place is not exact.
float begin_of_cell(const CellSpace& space, std::uint32_t cell, std::size_t axis) {
  std::uint32_t first = ordered_key(-most);
  std::uint32_t last = ordered_key(most);
  while (first < last) {
    const std::uint32_t middle = first + (last - first) / 2;
    if (space.cell(coordinate_of(middle), axis) < cell) {
      first = middle + 1;
    } else {
      last = middle;
    }
  }
  return coordinate_of(first);
}

}  // namespace

Aabb box_of_cell(const CellSpace& space, const std::array<std::uint32_t, 3>& cell,
                 const Aabb& region) {
  Aabb box = region;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (cell[axis] > 0) box.min[axis] = begin_of_cell(space, cell[axis], axis);
    if (cell[axis] < space.last[axis]) {
      box.max[axis] = begin_of_cell(space, cell[axis] + 1, axis);
      continue;
    }
    // The end is infinite on an axis on which the cells have no size.
    const double end = space.origin[axis] + (space.last[axis] + 1.0) / space.inverse_side[axis];
    if (end <= most) box.max[axis] = std::max(box.max[axis], round_up(end));
  }
  return box;
}

double BoxSample::extent() const {
  return std::max(
      {(high[0] - low[0]) / side[0], (high[1] - low[1]) / side[1], (high[2] - low[2]) / side[2]});
}

BoxSample sample_boxes(std::span<const Aabb> boxes, std::span<const std::uint32_t> ids) {
  BoxSample sample;
  if (ids.empty()) return sample;
  const std::size_t count = std::min(ids.size(), sample_size);
  std::array<Aabb, sample_size> taken;
  for (std::size_t i = 0; i < count; ++i) taken[i] = boxes[ids[i * ids.size() / count]];

  std::array<double, sample_size> values;
  const auto quantile = [&](std::size_t percent, const auto& value) {
    std::transform(taken.begin(), taken.begin() + count, values.begin(), value);
    const auto at = values.begin() + (count - 1) * percent / 100;
    std::nth_element(values.begin(), at, values.begin() + count);
    return *at;
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto min = [=](const Aabb& box) { return double{box.min[axis]}; };
    const auto max = [=](const Aabb& box) { return double{box.max[axis]}; };
    const double low = quantile(2, min);
    const double high = quantile(98, max);
    sample.low[axis] = std::max(quantile(0, min), low - 0.5 * (high - low));
    sample.high[axis] = std::min(quantile(100, max), high + 0.5 * (high - low));
    sample.side[axis] = quantile(90, [&](const Aabb& box) { return max(box) - min(box); });
  }
  double instead = std::ranges::max(sample.side);
  for (std::size_t axis = 0; axis < 3 && instead == 0; ++axis) {
    instead = sample.high[axis] - sample.low[axis];
  }
  std::ranges::replace(sample.side, 0.0, instead > 0 ? instead : 1);

  const CellSpace unit{
      .inverse_side = {1 / sample.side[0], 1 / sample.side[1], 1 / sample.side[2]}};
  const auto size = [&](const Aabb& box) { return unit.size(box); };
  sample.usual = quantile(90, size);
  sample.smallest = quantile(0, size);
  return sample;
}

double clustering_of(std::span<const Aabb> boxes, std::span<const std::uint32_t> ids,
                     const BoxSample& sample) {
  // The cells are few enough that two bodies spread evenly meet a dozen times.
  constexpr std::size_t most_cells = 32 * 32 * 32;
  const bool are_few = ids.size() < 8192;
  const std::size_t side = are_few ? 8 : 32;
  const std::size_t count = std::min<std::size_t>(ids.size(), are_few ? 128 : 1024);
  if (count < 2) return 1;
  CellSpace space{.origin = sample.low};
  space.last.fill(static_cast<std::uint32_t>(side) - 1);
  std::size_t apart = 1;  // number of cells that the region's extents distinguish
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double extent = sample.high[axis] - sample.low[axis];
    space.inverse_side[axis] = extent > 0 ? static_cast<double>(side) / extent : 0;
    apart *= extent > 0 ? side : 1;
  }
  std::array<std::uint16_t, most_cells> members;
  std::fill_n(members.begin(), side * side * side, std::uint16_t{0});
  std::size_t meetings = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Aabb& box = boxes[ids[i * ids.size() / count]];
    std::size_t cell = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      cell = cell * side + space.cell(box.min[axis], axis);
    }
    meetings += members[cell]++;
  }
  const double possible = 0.5 * static_cast<double>(count) * static_cast<double>(count - 1);
  return std::max(1.0, static_cast<double>(meetings * apart) / possible);
}

}  // namespace touchstone
