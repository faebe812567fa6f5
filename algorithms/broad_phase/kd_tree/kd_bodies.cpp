// Part of kd-tree: the split of a node's bodies at a plane.
#include "algorithms/broad_phase/kd_tree/kd_bodies.h"

#include <cmath>

#include "algorithms/core/executor/parallel_blocks.h"
#include "algorithms/core/memory_usage.h"
#include "algorithms/kernels/grid/cell_space.h"

namespace touchstone {

KdPart KdBodies::start(Executor& executor, std::span<const Aabb> boxes,
                       std::span<const std::uint32_t> ids) {
  bodies_.resize(ids.size());
  ranges_.assign(block_count(ids.size(), block_size), {});
  for_each_block(executor, ids.size(), block_size,
                 [&](std::size_t block, std::size_t first, std::size_t last) {
                   KdRange range;
                   for (std::size_t i = first; i < last; ++i) {
                     const KdBody& b = bodies_[i] = body(boxes, ids[i]);
                     range.add(b);
                     for (std::size_t axis = 0; axis < 3; ++axis) {
                       range.sum_of_sizes[axis] += double{b.max[axis]} - b.min[axis];
                     }
                   }
                   ranges_[block] = range;
                 });
  KdRange all;
  for (const KdRange& range : ranges_) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      all.low[axis] = std::min(all.low[axis], range.low[axis]);
      all.high[axis] = std::max(all.high[axis], range.high[axis]);
      all.size[axis] = std::max(all.size[axis], range.size[axis]);
      all.sum_of_sizes[axis] += range.sum_of_sizes[axis];
    }
  }
  const std::array<double, 3> sides = with_floor(all.sum_of_sizes);
  for (std::size_t axis = 0; axis < 3; ++axis) weight_[axis] = 1 / sides[axis];
  return {0, static_cast<std::uint32_t>(bodies_.size()), all};
}

std::size_t KdBodies::longest(const KdRange& range) const {
  std::array<double, 3> length;
  for (std::size_t axis = 0; axis < 3; ++axis) length[axis] = range.extent(axis) * weight_[axis];
  return static_cast<std::size_t>(std::ranges::max_element(length) - length.begin());
}

// Moves the bodies for which the condition holds to the front and returns their end. It has no
// branch, because that would be mispredicted half the time.
template <class Condition>
std::uint32_t KdBodies::divide(std::uint32_t first, std::uint32_t last, const Condition& holds) {
  std::uint32_t end = first;
  for (std::uint32_t i = first; i < last; ++i) {
    const KdBody b = bodies_[i];
    bodies_[i] = bodies_[end];
    bodies_[end] = b;
    end += holds(b) ? 1 : 0;
  }
  return end;
}

// Moves the bodies larger than the limit on the axis to the front, unless they are many, and
// returns their end.
std::uint32_t KdBodies::keep(std::uint32_t first, std::uint32_t last, std::size_t axis,
                             double limit, KdRange& range) {
  if (range.size[axis] <= limit) return first;
  std::uint32_t count = 0;
  float greatest = 0;
  for (std::uint32_t i = first; i < last; ++i) {
    const float size = bodies_[i].size(axis);
    const bool large = size > limit;
    count += large ? 1 : 0;
    greatest = std::max(greatest, large ? 0 : size);
  }
  // Large bodies are all tested against each other, so their number is limited.
  const double all = last - first;
  if (count > std::min(all / 8, 16 * std::sqrt(all))) return first;
  range.size[axis] = greatest;
  if (count == 0) return first;
  return divide(first, last, [&](const KdBody& b) { return b.size(axis) > limit; });
}

KdSplit KdBodies::split(const KdPart& from) {
  KdSplit split;
  KdRange range = from.range;
  std::uint32_t first = from.first;
  const std::uint32_t last = from.last;
  for (int attempt = 0; last - first > leaf_size; ++attempt) {
    if (attempt == 1) {
      range = {};
      for (std::uint32_t i = first; i < last; ++i) range.add(bodies_[i]);
    }
    const std::size_t axis = longest(range);
    if (attempt > 0 && !(range.extent(axis) > 0)) break;
    first = keep(first, last, axis, range.extent(axis) / 2, range);
    const std::uint32_t count = last - first;
    float at = 0.5f * range.low[axis] + 0.5f * range.high[axis];
    std::uint32_t middle = first + count / 2;
    if (attempt < 2) {
      middle = divide(first, last, [&](const KdBody& b) { return b.centre(axis) < at; });
      const std::uint32_t smaller = std::min(middle - first, last - middle);
      if (smaller < std::max(least_members, count / 8)) continue;
    } else {
      const auto place = [&](std::uint32_t i) { return bodies_.begin() + std::ptrdiff_t{i}; };
      std::nth_element(
          place(first), place(middle), place(last),
          [&](const KdBody& a, const KdBody& b) { return a.centre(axis) < b.centre(axis); });
      at = bodies_[middle].centre(axis);
    }
    if (count <= leaf_size) break;
    split = {first, {{{first, middle, range}, {middle, last, range}}}};
    split.children[0].range.high[axis] = at;
    split.children[1].range.low[axis] = at;
    return split;
  }
  split.own_end = last;
  return split;
}

void KdBodies::update(Executor& executor, std::span<const Aabb> boxes) {
  for_each_block(executor, bodies_.size(), block_size,
                 [&](std::size_t, std::size_t first, std::size_t last) {
                   for (std::size_t i = first; i < last; ++i) {
                     bodies_[i] = body(boxes, bodies_[i].id);
                   }
                 });
}

std::size_t KdBodies::held_bytes() const {
  return static_cast<std::size_t>(sum_held_bytes(bodies_, ranges_));
}

}  // namespace touchstone
