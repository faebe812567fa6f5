// Group scans: the choice of the instruction level, and their work.
#include "algorithms/kernels/boxes/group_scan.h"

#include <algorithm>
#include <utility>

#include "algorithms/kernels/boxes/aabb_simd.h"

namespace touchstone {
namespace {

using aabb_simd::Columns;
using aabb_simd::columns_of;
using aabb_simd::first_lanes;

#define TOUCHSTONE_TARGET_NAMESPACE aabb_simd
#define TOUCHSTONE_TARGET_INCLUDE "algorithms/kernels/boxes/group_scan.inl"
#include "algorithms/kernels/simd/foreach_target.inl"

// Returns the least of some numbers and the greatest of as many others, four at a time; the last
// four may overlap the four before.
std::pair<float, float> ends_of(const float* low, const float* high, std::size_t count) {
  using Four = simd::baseline::Simd<float>;
  if (count < Four::width)
    return {*std::min_element(low, low + count), *std::max_element(high, high + count)};
  Four::Vector least = Four::load(low);
  Four::Vector greatest = Four::load(high);
  for (std::size_t i = Four::width; i < count; i += Four::width) {
    const std::size_t at = std::min(i, count - Four::width);
    const Four::Vector l = Four::load(low + at);
    const Four::Vector h = Four::load(high + at);
    least = l < least ? l : least;
    greatest = h > greatest ? h : greatest;
  }
  return {simd::reduce_min4(least), simd::reduce_max4(greatest)};
}

}  // namespace

Aabb bounds_of(const AabbSoA& boxes, IndexRange range) {
  Aabb bounds{};
  for (int axis = 0; axis < 3; ++axis) {
    const std::size_t count = range.last - range.first;
    const auto [low, high] =
        ends_of(boxes.min(axis) + range.first, boxes.max(axis) + range.first, count);
    bounds.min[static_cast<std::size_t>(axis)] = low;
    bounds.max[static_cast<std::size_t>(axis)] = high;
  }
  return bounds;
}

void scan_group(const AabbSoA& boxes, IndexRange group, const Aabb& bounds,
                std::span<const IndexRange> others, GroupScratch& scratch, PairBuffer& out) {
  const Columns columns = columns_of(boxes);
  const auto scan = [&] {
    switch (isa()) {
      case Isa::avx512: return avx512::scan(columns, group, bounds, others, scratch.lists, out);
      case Isa::avx2: return avx2::scan(columns, group, bounds, others, scratch.lists, out);
      default: return baseline::scan(columns, group, bounds, others, scratch.lists, out);
    }
  };
  const auto near = static_cast<std::int64_t>(scan());
  const auto size = static_cast<std::int64_t>(group.last - group.first);
  const std::int64_t candidates = near * size + size * (size - 1) / 2;
  scratch.work.candidates += candidates;
  scratch.work.box_tests += candidates;
  for (const IndexRange range : others) {
    scratch.work.box_tests += static_cast<std::int64_t>(range.last - range.first);
  }
}

}  // namespace touchstone
