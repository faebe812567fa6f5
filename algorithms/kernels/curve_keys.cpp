#include "algorithms/kernels/curve_keys.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "algorithms/kernels/blocks.h"
#include "algorithms/kernels/cell_space.h"
#include "algorithms/kernels/held_bytes.h"
#include "algorithms/kernels/hilbert.h"

namespace touchstone {
namespace {

constexpr std::size_t bodies_a_block = 8192;
constexpr int most_code_bits = 30;  // those of a HilbertGrid

int bits_of(std::size_t x) { return static_cast<int>(std::bit_width(x)); }

}  // namespace

// By the exponent of the longest side.
std::size_t CurveKeys::magnitude(const Aabb& box) {
  const float side =
      std::max({box.max[0] - box.min[0], box.max[1] - box.min[1], box.max[2] - box.min[2]});
  return std::bit_cast<std::uint32_t>(side) >> 24 & (magnitudes - 1);
}

CurveKeys::Members CurveKeys::count_members(Executor& executor, std::span<const Aabb> boxes,
                                            std::span<const std::uint32_t> ids) {
  counts_.resize(block_count(ids.size(), bodies_a_block));
  for_each_block(executor, ids.size(), bodies_a_block,
                 [&](std::size_t block, std::size_t first, std::size_t last) {
                   Members members{};
                   for (std::size_t i = first; i < last; ++i) ++members[magnitude(boxes[ids[i]])];
                   counts_[block] = members;
                 });
  Members all{};
  for (const Members& members : counts_) {
    for (std::size_t i = 0; i < magnitudes; ++i) all[i] += members[i];
  }
  return all;
}

// The class of each magnitude, from the smallest up. A class is closed when it has members enough;
// the largest few have one of their own, however few they are.
CurveKeys::ClassOf CurveKeys::make_classes(const Members& of_magnitude) {
  ClassOf class_of{};
  std::uint8_t last = 0;
  std::size_t members = 0;
  for (std::size_t i = 0; i < magnitudes; ++i) {
    class_of[i] = last;
    members += of_magnitude[i];
    if (members >= least_members && last + 1u < most_classes) {
      ++last;
      members = 0;
    }
  }
  return class_of;
}

void CurveKeys::sort(Executor& executor, std::span<const Aabb> boxes,
                     std::span<const std::uint32_t> ids) {
  items_.resize(ids.size());
  if (ids.empty()) return;
  const ClassOf class_of = make_classes(count_members(executor, boxes, ids));
  id_bits_ = bits_of(boxes.size());
  // The region where most of them are: those outside are at the curve's nearest place.
  const BoxSample sample = sample_boxes(boxes, ids);
  std::array<float, 3> low, high;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    // As floats, which the doubled centres of the greatest boxes are not.
    constexpr double most = std::numeric_limits<float>::max();
    low[axis] = static_cast<float>(std::clamp(2 * sample.low[axis], -most, most));
    high[axis] = static_cast<float>(std::clamp(2 * sample.high[axis], -most, most));
  }
  // Sixteen cells a body tell bodies apart where they are; more would only make the sort longer.
  const int crowded = static_cast<int>(std::log2(crowding(boxes, ids, sample)));
  const int wanted = (bits_of(ids.size()) + crowded + 4 + 2) / 3 * 3;
  const HilbertGrid grid(low, high, std::min({wanted, most_code_bits, 60 - id_bits_}));
  for_each_block(executor, ids.size(), 1024, [&](std::size_t, std::size_t first, std::size_t last) {
    std::array<std::uint32_t, 1024> codes;
    grid.codes(boxes, ids.subspan(first, last - first), codes.data());
    for (std::size_t i = first; i < last; ++i) {
      const std::uint64_t own = class_of[magnitude(boxes[ids[i]])];
      const std::uint64_t key = own << grid.code_bits() | codes[i - first];
      items_[i] = key << id_bits_ | ids[i];
    }
  });
  const int class_bits = bits_of(class_of.back());
  radix_sort_(executor, items_, grid.code_bits() + class_bits,
              [bits = id_bits_](std::uint64_t item) { return item >> bits; });
}

std::size_t CurveKeys::held_bytes() const {
  return touchstone::held_bytes(items_) + touchstone::held_bytes(radix_sort_) +
         touchstone::held_bytes(counts_);
}

}  // namespace touchstone
