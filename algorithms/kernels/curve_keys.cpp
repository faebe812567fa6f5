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
constexpr std::size_t group = 1024;  // that codes are computed for at a time
constexpr std::size_t least_crowd = 32;
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
  for_each_block(executor, ids.size(), group,
                 [&](std::size_t, std::size_t first, std::size_t last) {
                   std::array<std::uint32_t, group> codes;
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
  refine_crowds(boxes);
}

void CurveKeys::refine_crowds(std::span<const Aabb> boxes) {
  crowds_.clear();
  for (std::size_t i = 0; i + least_crowd < size();) {
    if (key(i) != key(i + least_crowd)) {
      ++i;
      continue;
    }
    std::size_t end = i + least_crowd;
    while (end < size() && key(end) == key(i)) ++end;
    crowds_.push_back({i, end});
    i = end;
  }
  // Each may leave smaller ones behind.
  while (!crowds_.empty()) {
    const IndexRange crowd = crowds_.back();
    crowds_.pop_back();
    refine(boxes, crowd.first, crowd.last);
  }
}

void CurveKeys::refine(std::span<const Aabb> boxes, std::size_t first, std::size_t last) {
  constexpr float most = std::numeric_limits<float>::max();
  std::array<float, 3> low{most, most, most}, high{-most, -most, -most};
  places_.clear();
  for (std::size_t i = first; i < last; ++i) {
    const Aabb& box = boxes[id(i)];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float centre = std::clamp(box.min[axis] + box.max[axis], -most, most);
      low[axis] = std::min(low[axis], centre);
      high[axis] = std::max(high[axis], centre);
    }
  }
  if (low == high) return;
  // The ends of the longest axis are in its first and last cells: what has one place is less.
  const HilbertGrid grid(low, high, most_code_bits);
  for (std::size_t i = first; i < last; i += group) {
    const std::size_t count = std::min(group, last - i);
    std::array<std::uint32_t, group> ids, codes;
    for (std::size_t k = 0; k < count; ++k) ids[k] = id(i + k);
    grid.codes(boxes, std::span(ids).first(count), codes.data());
    for (std::size_t k = 0; k < count; ++k) {
      places_.push_back(std::uint64_t{codes[k]} << 32 | ids[k]);
    }
  }
  std::ranges::sort(places_);
  const std::uint64_t key_of_all = key(first);
  std::size_t begin = 0;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    items_[first + i] = key_of_all << id_bits_ | (places_[i] & 0xffffffff);
    if (places_[i] >> 32 != places_[begin] >> 32) begin = i;
    const bool ends = i + 1 == places_.size() || places_[i + 1] >> 32 != places_[i] >> 32;
    if (ends && i + 1 - begin > least_crowd && i + 1 - begin < places_.size()) {
      crowds_.push_back({first + begin, first + i + 1});
    }
  }
}

std::size_t CurveKeys::held_bytes() const {
  return touchstone::held_bytes(items_) + touchstone::held_bytes(radix_sort_) +
         touchstone::held_bytes(counts_) + touchstone::held_bytes(crowds_) +
         touchstone::held_bytes(places_);
}

}  // namespace touchstone
