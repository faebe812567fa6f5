// Hilbert sort: the sort by key, and finer curves for dense cells.
#include "algorithms/kernels/bvh/hilbert_sort.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "algorithms/core/executor/parallel_blocks.h"
#include "algorithms/core/memory_usage.h"
#include "algorithms/kernels/bvh/hilbert.h"
#include "algorithms/kernels/bvh/implicit_rtree.h"
#include "algorithms/kernels/bvh/size_classes.h"

namespace touchstone {
namespace {

constexpr std::size_t boxes_at_once = 1024;
// Cells of the curve for each body, as a power of two: more lengthen the sort, fewer worsen the
// order.
constexpr int cells_a_body_log2 = 1;
// A cell of the curve with more boxes gets a curve of its own.
constexpr std::size_t most_in_cell = 32;

// Returns the first place after these at which a class may begin.
std::size_t round_up(std::size_t places) {
  constexpr std::size_t group = ImplicitRTree::group;
  return block_count(places, group) * group;
}

int bits_of(std::size_t x) { return static_cast<int>(std::bit_width(x)); }

// Sorts items by these bits of theirs, least significant digit first, and keeps the order of those
// that are equal. `spare` has as many items.
void sort_by_bits(std::span<std::uint64_t> items, std::span<std::uint64_t> spare, int first_bit,
                  int bits) {
  // Wider digits need fewer passes, but their counts cost more than few items save.
  constexpr int widest_of_all = 11;
  const int widest = items.size() < 512 ? 6 : items.size() < 16384 ? 8 : widest_of_all;
  const int passes = (bits + widest - 1) / widest;
  const int width = (bits + passes - 1) / passes;
  const std::uint64_t mask = (std::uint64_t{1} << width) - 1;
  std::array<std::uint32_t, 1 << widest_of_all> places;
  const std::span<std::uint64_t> sorted = items;
  for (int pass = 0; pass < passes; ++pass) {
    const int shift = first_bit + pass * width;
    std::fill_n(places.begin(), mask + 1, 0);
    for (const std::uint64_t item : items) ++places[item >> shift & mask];
    std::uint32_t place = 0;
    for (std::size_t digit = 0; digit <= mask; ++digit) {
      place += std::exchange(places[digit], place);
    }
    for (const std::uint64_t item : items) spare[places[item >> shift & mask]++] = item;
    std::swap(items, spare);
  }
  if (items.data() != sorted.data()) std::ranges::copy(items, sorted.begin());
}

}  // namespace

void HilbertSort::make(Executor& executor, std::span<const Aabb> boxes) {
  const SizeSample sample = take_sample(boxes);
  used_ = 0;
  if (sample.empty()) return;
  const SizeClasses classes(sample);
  order_.resize(boxes.size());
  id_bits_ = bits_of(boxes.size());
  const int wanted = (bits_of(boxes.size()) + cells_a_body_log2 + 2) / 3 * 3;
  const HilbertGrid grid(sample.region.low, sample.region.high, std::min(wanted, 30));
  for_each_block(executor, boxes.size(), boxes_at_once,
                 [&](std::size_t, std::size_t first, std::size_t last) {
                   const std::span<const Aabb> some = boxes.subspan(first, last - first);
                   std::array<std::uint32_t, boxes_at_once> codes, own;
                   grid.codes(some, codes.data());
                   classes.of(some, own.data());
                   for (std::size_t i = first; i < last; ++i) {
                     const std::uint64_t key =
                         std::uint64_t{own[i - first]} << grid.code_bits() | codes[i - first];
                     order_[i] = key << id_bits_ | i;
                   }
                 });
  radix_sort_(executor, order_, grid.code_bits() + bits_of(classes.count()),
              [bits = id_bits_](std::uint64_t item) { return item >> bits; });
  for (std::size_t at = 1; at <= classes.count(); ++at) {
    const std::uint64_t least = std::uint64_t{at} << (grid.code_bits() + id_bits_);
    const auto end = std::lower_bound(order_.begin(), order_.end(), least);
    const auto begin = static_cast<std::size_t>(end - order_.begin());
    if (begin > begins_[used_]) begins_[++used_] = begin;
  }
  order_.resize(begins_[used_]);
  refine_runs(executor, boxes);
}

// Finds cells that hold too many boxes, and refines each.
void HilbertSort::refine_runs(Executor& executor, std::span<const Aabb> boxes) {
  constexpr std::size_t stride = most_in_cell / 2;
  runs_.clear();
  std::size_t from = 0;
  for (std::size_t i = stride; i < order_.size(); i += stride) {
    if (i < from || key(i - stride) != key(i)) continue;
    std::size_t first = i - stride;
    while (first > from && key(first - 1) == key(i)) --first;
    from = i + 1;
    while (from < order_.size() && key(from) == key(i)) ++from;
    if (from - first > most_in_cell) runs_.push_back({first, from});
  }
  if (!runs_.empty()) spare_.resize(order_.size());
  const auto task = [&](std::size_t i, int) { refine(boxes, runs_[i].first, runs_[i].last, 0); };
  executor.run(runs_.size(), std::cref(task));
}

// Sorts boxes first <= i < last, which share a key and keep it, along a curve of their own.
void HilbertSort::refine(std::span<const Aabb> boxes, std::size_t first, std::size_t last,
                         int depth) {
  // The boxes are scattered in memory, so they are prefetched.
  constexpr std::size_t ahead = 24;
  const auto prefetch = [&](std::size_t i) {
    if (i + ahead < last) __builtin_prefetch(&boxes[id(i + ahead)]);
  };
  CentreRegion region;
  for (std::size_t i = first; i < last; ++i) {
    prefetch(i);
    region.add(boxes[id(i)]);
  }
  if (region.low == region.high) return;
  const std::uint64_t key_of_all = key(first);
  const HilbertGrid grid(region.low, region.high,
                         std::min((bits_of(last - first) + cells_a_body_log2 + 2) / 3 * 3, 30));
  std::array<Aabb, 64> some;
  std::array<std::uint32_t, 64> codes;
  for (std::size_t i = first; i < last; i += some.size()) {
    const std::size_t count = std::min(some.size(), last - i);
    for (std::size_t k = 0; k < count; ++k) {
      prefetch(i + k);
      some[k] = boxes[id(i + k)];
    }
    grid.codes(std::span(some).first(count), codes.data());
    for (std::size_t k = 0; k < count; ++k) {
      order_[i + k] = std::uint64_t{codes[k]} << id_bits_ | id(i + k);
    }
  }
  // Ids ascend within a key, here and below.
  sort_by_bits(std::span(order_).subspan(first, last - first),
               std::span(spare_).subspan(first, last - first), id_bits_, grid.code_bits());
  // Each curve is at least four times as fine as the last; floats cannot be refined further than
  // this.
  constexpr int deepest = 64;
  for (std::size_t i = first; depth < deepest && i < last;) {
    std::size_t end = i + 1;
    while (end < last && key(end) == key(i)) ++end;
    if (end - i > most_in_cell) refine(boxes, i, end, depth + 1);
    i = end;
  }
  for (std::size_t i = first; i < last; ++i) order_[i] = key_of_all << id_bits_ | id(i);
}

std::size_t HilbertSort::places() const {
  std::size_t places = 0;
  for (std::size_t at = 0; at < used_; ++at) {
    places = round_up(places) + begins_[at + 1] - begins_[at];
  }
  return places;
}

void HilbertSort::gather(std::span<const Aabb> boxes, std::size_t first, std::size_t last,
                         AabbSoA& arrays) const {
  std::size_t place = 0;  // of the class's first box
  for (std::size_t at = 0; at < used_ && place < last; ++at) {
    const std::size_t end = place + begins_[at + 1] - begins_[at];
    std::array<std::uint32_t, boxes_at_once> ids;
    const std::size_t to = std::min(end, last);
    for (std::size_t from = std::max(place, first); from < to; from += ids.size()) {
      const std::size_t count = std::min(ids.size(), to - from);
      for (std::size_t i = 0; i < count; ++i) ids[i] = id(begins_[at] + (from - place) + i);
      arrays.set(from, boxes, std::span(ids).first(count));
    }
    place = round_up(end);
    for (std::size_t i = std::max(end, first); i < std::min(place, last); ++i) {
      arrays.set(i, Aabb::empty(), 0);
    }
  }
}

std::size_t HilbertSort::held_bytes() const {
  return static_cast<std::size_t>(sum_held_bytes(order_, spare_, radix_sort_, runs_));
}

}  // namespace touchstone
