#include "algorithms/kernels/curve_order.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "algorithms/kernels/blocks.h"
#include "algorithms/kernels/box_pyramid.h"
#include "algorithms/kernels/held_bytes.h"
#include "algorithms/kernels/hilbert.h"

namespace touchstone {
namespace {

constexpr std::size_t block_size = 8192;
constexpr std::size_t boxes_at_once = 1024;
// Cells of the curve a body, as a power of two: more would make the sort longer, fewer the order
// worse.
constexpr int cells_a_body_log2 = 1;
// A class of fewer goes into the next larger one.
constexpr std::size_t least_members = 64;
// More boxes than these in one cell of the curve get a curve of their own.
constexpr std::size_t most_in_cell = 128;

int bits_of(std::size_t x) { return static_cast<int>(std::bit_width(x)); }

struct Region {
  static constexpr float inf = std::numeric_limits<float>::infinity();
  std::array<float, 3> low{inf, inf, inf}, high{-inf, -inf, -inf};  // of doubled centres

  void add(const Aabb& box) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float centre = box.min[axis] + box.max[axis];
      low[axis] = std::min(low[axis], centre);
      high[axis] = std::max(high[axis], centre);
    }
  }
};

// By the exponent of the longest side.
std::size_t magnitude(const Aabb& box) {
  const float side =
      std::max({box.max[0] - box.min[0], box.max[1] - box.min[1], box.max[2] - box.min[2]});
  return std::bit_cast<std::uint32_t>(side) >> 24 & 127;
}

}  // namespace

CurveOrder::Range CurveOrder::measure(Executor& executor, std::span<const Aabb> boxes) {
  ranges_.resize(block_count(boxes.size(), block_size));
  for_each_block(executor, boxes.size(), block_size,
                 [&](std::size_t block, std::size_t first, std::size_t last) {
                   Region region;
                   std::array<std::uint32_t, magnitudes> members{};
                   for (const Aabb& box : boxes.subspan(first, last - first)) {
                     if (box.is_empty()) continue;
                     region.add(box);
                     ++members[magnitude(box)];
                   }
                   ranges_[block] = {region.low, region.high, members};
                 });
  const Region nothing;
  Range all{nothing.low, nothing.high, {}};
  for (const Range& range : ranges_) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      all.low[axis] = std::min(all.low[axis], range.low[axis]);
      all.high[axis] = std::max(all.high[axis], range.high[axis]);
    }
    for (std::size_t i = 0; i < magnitudes; ++i) all.members[i] += range.members[i];
  }
  return all;
}

// The class of each magnitude, from the smallest up. A class is closed when it has members enough;
// the largest few have one of their own, however few they are.
std::array<std::uint8_t, CurveOrder::magnitudes> CurveOrder::make_classes(const Range& range) {
  std::array<std::uint8_t, magnitudes> class_of{};
  used_ = 0;
  begins_ = {};
  std::size_t members = 0;
  for (std::size_t i = 0; i < magnitudes; ++i) {
    class_of[i] = static_cast<std::uint8_t>(used_);
    members += range.members[i];
    begins_[used_ + 1] = begins_[used_] + members;
    if (members >= least_members && used_ + 1 < most_classes) {
      ++used_;
      members = 0;
      begins_[used_ + 1] = begins_[used_];
    }
  }
  used_ += members > 0 ? 1 : 0;
  return class_of;
}

void CurveOrder::make(Executor& executor, std::span<const Aabb> boxes) {
  const Range range = measure(executor, boxes);
  const std::array<std::uint8_t, magnitudes> class_of = make_classes(range);
  const std::size_t bodies = begins_[used_];
  order_.resize(boxes.size());
  id_bits_ = bits_of(boxes.size());
  if (used_ == 0) return;
  // Cells enough to tell bodies apart; more would only make the sort longer.
  const int wanted = (bits_of(bodies) + cells_a_body_log2 + 2) / 3 * 3;
  // Empty boxes come last, and are cut off.
  const int class_bits = bits_of(bodies < boxes.size() ? used_ : used_ - 1);
  const HilbertGrid grid(range.low, range.high, std::min(wanted, 30));
  for_each_block(
      executor, boxes.size(), boxes_at_once, [&](std::size_t, std::size_t first, std::size_t last) {
        std::array<std::uint32_t, boxes_at_once> codes;
        grid.codes(boxes.subspan(first, last - first), codes.data());
        for (std::size_t i = first; i < last; ++i) {
          const std::uint64_t own = boxes[i].is_empty() ? used_ : class_of[magnitude(boxes[i])];
          const std::uint64_t key = own << grid.code_bits() | codes[i - first];
          order_[i] = key << id_bits_ | i;
        }
      });
  radix_sort_(executor, order_, grid.code_bits() + class_bits,
              [bits = id_bits_](std::uint64_t item) { return item >> bits; });
  order_.resize(bodies);
  refine_runs(executor, boxes);
}

// Finds the cells that hold too many.
void CurveOrder::refine_runs(Executor& executor, std::span<const Aabb> boxes) {
  constexpr std::size_t stride = most_in_cell / 2;
  std::size_t from = 0;
  for (std::size_t i = stride; i < order_.size(); i += stride) {
    if (i < from || code(i - stride) != code(i)) continue;
    const auto same = [&, wanted = code(i)](std::uint64_t item) {
      return item >> id_bits_ == wanted;
    };
    std::size_t first = i - stride;
    while (first > from && code(first - 1) == code(i)) --first;
    const auto end =
        std::find_if_not(order_.begin() + static_cast<std::ptrdiff_t>(i), order_.end(), same);
    from = static_cast<std::size_t>(end - order_.begin());
    if (from - first > most_in_cell) refine(boxes, first, from, 0);
  }
  static_cast<void>(executor);
}

// Draws a curve through boxes first <= i < last of the order.
void CurveOrder::refine(std::span<const Aabb> boxes, std::size_t first, std::size_t last,
                        int depth) {
  Region region;
  for (std::size_t i = first; i < last; ++i) region.add(boxes[id(i)]);
  if (region.low == region.high) return;
  const HilbertGrid grid(region.low, region.high,
                         std::min((bits_of(last - first) + cells_a_body_log2 + 2) / 3 * 3, 30));
  std::array<Aabb, 64> some;
  std::array<std::uint32_t, 64> codes;
  for (std::size_t i = first; i < last; i += some.size()) {
    const std::size_t count = std::min(some.size(), last - i);
    for (std::size_t k = 0; k < count; ++k) some[k] = boxes[id(i + k)];
    grid.codes(std::span(some).first(count), codes.data());
    for (std::size_t k = 0; k < count; ++k) {
      order_[i + k] = std::uint64_t{codes[k]} << id_bits_ | id(i + k);
    }
  }
  const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::sort(at(first), at(last));
  // Each curve is at least four times as fine; floats have no more than this.
  constexpr int deepest = 64;
  for (std::size_t i = first; depth < deepest && i < last;) {
    std::size_t end = i + 1;
    while (end < last && code(end) == code(i)) ++end;
    if (end - i > most_in_cell) refine(boxes, i, end, depth + 1);
    i = end;
  }
}

void CurveOrder::gather(Executor& executor, std::span<const Aabb> boxes, BoxArrays& arrays) const {
  constexpr std::size_t group = BoxPyramid::group;
  std::size_t places = 0;
  for (std::size_t at = 0; at < used_; ++at) {
    if (at > 0) places = block_count(places, group) * group;
    places += begins_[at + 1] - begins_[at];
  }
  arrays.resize(places);
  std::size_t place = 0;
  for (std::size_t at = 0; at < used_; ++at) {
    for (; place % group != 0; ++place) arrays.set(place, Aabb::empty(), 0);
    const std::size_t begin = begins_[at];
    const std::size_t members = begins_[at + 1] - begin;
    for_each_block(executor, members, block_size,
                   [&](std::size_t, std::size_t first, std::size_t last) {
                     for (std::size_t i = first; i < last; ++i) {
                       const std::uint32_t body = id(begin + i);
                       arrays.set(place + i, boxes[body], body);
                     }
                   });
    place += members;
  }
}

std::size_t CurveOrder::held_bytes() const {
  return static_cast<std::size_t>(sum_held_bytes(order_, radix_sort_, ranges_));
}

}  // namespace touchstone
