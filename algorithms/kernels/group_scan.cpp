#include "algorithms/kernels/group_scan.h"

#include <limits>

#include "algorithms/kernels/box_lanes.h"

namespace touchstone {
namespace {

using box_lanes::Columns;
using box_lanes::columns_of;

#define TOUCHSTONE_LOOPS "algorithms/kernels/group_scan.inl"
#include "algorithms/kernels/every_level.inl"

}  // namespace

Aabb bounds_of(const BoxArrays& boxes, IndexRange range) {
  Aabb bounds{};
  for (int axis = 0; axis < 3; ++axis) {
    const float* const min = boxes.min(axis);
    const float* const max = boxes.max(axis);
    float low = std::numeric_limits<float>::infinity();
    float high = -low;
    for (std::size_t i = range.first; i < range.last; ++i) {
      low = min[i] < low ? min[i] : low;
      high = max[i] > high ? max[i] : high;
    }
    bounds.min[static_cast<std::size_t>(axis)] = low;
    bounds.max[static_cast<std::size_t>(axis)] = high;
  }
  return bounds;
}

void scan_group(const BoxArrays& boxes, IndexRange group, const Aabb& bounds,
                std::span<const IndexRange> others, GroupScratch& scratch, PairBuffer& out) {
  std::int64_t near = 0;
  std::uint32_t* const list = scratch.near.data();
  const Columns columns = columns_of(boxes);
  switch (isa()) {
    case Isa::avx512: avx512::scan(columns, group, bounds, others, list, near, out); break;
    case Isa::avx2: avx2::scan(columns, group, bounds, others, list, near, out); break;
    case Isa::baseline: baseline::scan(columns, group, bounds, others, list, near, out); break;
  }
  const auto size = static_cast<std::int64_t>(group.last - group.first);
  const std::int64_t candidates = near * size + size * (size - 1) / 2;
  scratch.work.candidates += candidates;
  scratch.work.box_tests += candidates;
  for (const IndexRange range : others) {
    scratch.work.box_tests += static_cast<std::int64_t>(range.last - range.first);
  }
}

}  // namespace touchstone
