#include "algorithms/kernels/box_pyramid.h"

#include <algorithm>
#include <limits>

#include "algorithms/kernels/blocks.h"
#include "algorithms/kernels/box_lanes.h"
#include "algorithms/kernels/held_bytes.h"

namespace touchstone {
namespace {

using box_lanes::Columns;
using box_lanes::columns_of;

// Where a search lists the bounds of blocks.
struct Bounds {
  float* min[3];
  float* max[3];
};

Bounds bounds_of(PyramidScratch& scratch) {
  auto& lists = scratch.bounds;
  return {{lists[0].data(), lists[1].data(), lists[2].data()},
          {lists[3].data(), lists[4].data(), lists[5].data()}};
}

// What the loops are given of the two pyramids.
struct Search {
  Columns rows, columns;              // the boxes
  Columns row_blocks, column_blocks;  // the bounds of their blocks
  Columns group_bounds;
  std::size_t group;  // its place in these
  std::uint32_t first_block, last_block;
  std::size_t row_count, column_count;
  std::span<const BoxArrays> levels;  // of the columns
  bool self;
};

// How many nodes of a level of this size, not before `from`, the parents have.
std::size_t children_of(const std::uint32_t* parents, std::size_t count, std::size_t size,
                        std::size_t from) {
  std::size_t children = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t first = parents[i] * BoxPyramid::fan;
    children += std::min(first + BoxPyramid::fan, size) - std::max(first, from);
  }
  return children;
}

namespace baseline {
using namespace box_lanes::baseline;
#define TOUCHSTONE_TARGET
#include "algorithms/kernels/box_pyramid.inl"
#undef TOUCHSTONE_TARGET
}  // namespace baseline

#if defined(__x86_64__)
namespace avx2 {
using namespace box_lanes::avx2;
#define TOUCHSTONE_TARGET TOUCHSTONE_TARGET_AVX2
#include "algorithms/kernels/box_pyramid.inl"
#undef TOUCHSTONE_TARGET
}  // namespace avx2

namespace avx512 {
using namespace box_lanes::avx512;
#define TOUCHSTONE_TARGET TOUCHSTONE_TARGET_AVX512
#include "algorithms/kernels/box_pyramid.inl"
#undef TOUCHSTONE_TARGET
}  // namespace avx512
#else
namespace avx2 = baseline;
namespace avx512 = baseline;
#endif

// The bounds of each 16 of `below`, which is padded with empty boxes.
void bound(Executor& executor, const BoxArrays& below, BoxArrays& above) {
  constexpr std::size_t fan = BoxPyramid::fan;
  const std::size_t count = block_count(below.size(), fan);
  above.resize(count);
  for_each_block(executor, count, 1024, [&](std::size_t, std::size_t first, std::size_t last) {
    for (int axis = 0; axis < 3; ++axis) {
      const float* const min = below.min(axis);
      const float* const max = below.max(axis);
      for (std::size_t i = first; i < last; ++i) {
        float low = std::numeric_limits<float>::infinity();
        float high = -low;
        for (std::size_t k = i * fan; k < i * fan + fan; ++k) {
          low = min[k] < low ? min[k] : low;
          high = max[k] > high ? max[k] : high;
        }
        above.min(axis)[i] = low;
        above.max(axis)[i] = high;
      }
    }
    for (std::size_t i = first; i < last; ++i) above.ids()[i] = static_cast<std::uint32_t>(i);
  });
}

}  // namespace

void BoxPyramid::fit(Executor& executor, const BoxArrays& boxes) {
  boxes_ = &boxes;
  used_ = 0;
  for (const BoxArrays* below = &boxes; below->size() > (used_ > 0 ? 1u : 0u);
       below = &levels_[used_ - 1]) {
    if (levels_.size() == used_) {
      // 2^32 boxes have eight levels: they stay where they are.
      levels_.reserve(8);
      levels_.emplace_back();
    }
    bound(executor, *below, levels_[used_++]);
  }
}

double BoxPyramid::spread() const {
  double sum = 0;
  if (used_ == 0) return sum;
  for (int axis = 0; axis < 3; ++axis) {
    const float* const min = levels_[0].min(axis);
    const float* const max = levels_[0].max(axis);
    for (std::size_t i = 0; i < levels_[0].size(); ++i) sum += double{max[i]} - min[i];
  }
  return sum;
}

std::size_t BoxPyramid::held_bytes() const {
  std::size_t bytes = 0;
  for (const BoxArrays& level : levels_) bytes += level.held_bytes();
  return bytes;
}

void PyramidScratch::make_room(std::size_t blocks) {
  constexpr std::size_t fan = BoxPyramid::fan;
  // A vector's width more, since whole vectors are written.
  const auto grow = [](auto& list, std::size_t size) {
    if (list.size() < size) list.resize(size);
  };
  grow(nodes, blocks + fan);
  grow(children, blocks + fan);
  for (std::vector<float>& list : bounds) grow(list, blocks + fan);
  grow(partners, blocks + fan);
}

void pair_group(const BoxPyramid& first, std::size_t group, const BoxPyramid& second,
                PyramidScratch& scratch, PairBuffer& out) {
  constexpr std::size_t fan = BoxPyramid::fan;
  const std::span<const BoxArrays> levels = first.levels();
  const BoxArrays& group_bounds = levels.size() > 1 ? levels[1] : levels[0];
  const Search search{
      .rows = columns_of(first.boxes()),
      .columns = columns_of(second.boxes()),
      .row_blocks = columns_of(levels[0]),
      .column_blocks = columns_of(second.levels()[0]),
      .group_bounds = columns_of(group_bounds),
      .group = group,
      .first_block = static_cast<std::uint32_t>(group * fan),
      .last_block = static_cast<std::uint32_t>(std::min((group + 1) * fan, levels[0].size())),
      .row_count = first.boxes().size(),
      .column_count = second.boxes().size(),
      .levels = second.levels(),
      .self = &first == &second};
  switch (isa()) {
    case Isa::avx512: return avx512::search(search, scratch, out);
    case Isa::avx2: return avx2::search(search, scratch, out);
    case Isa::baseline: return baseline::search(search, scratch, out);
  }
}

}  // namespace touchstone
