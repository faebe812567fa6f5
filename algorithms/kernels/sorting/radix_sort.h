// A stable least-significant-digit radix sort. It runs in parallel, and its result does not depend
// on the number of threads. Used by every broad phase that sorts.
// Paper: Zagha, Blelloch, "Radix Sort for Vector Multiprocessors", Supercomputing 1991 (a histogram
// for each block, one prefix sum over all of them, each block scatters its own items).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "algorithms/core/executor/executor.h"
#include "algorithms/core/executor/parallel_blocks.h"

namespace touchstone {

// The sorter keeps its scratch memory from call to call.
template <class Item>
class RadixSort {
 public:
  // Sorts by the `bits` bits of key(item) (an unsigned integer); higher bits must be zero.
  template <class Key>
  void operator()(Executor& executor, std::vector<Item>& items, int bits, const Key& key) {
    if (items.size() < 2 || bits == 0) return;
    // Wider digits need fewer passes, but their histograms cost more than few items save.
    const int widest = items.size() < 4096 ? 8 : 11;
    const int passes = (bits + widest - 1) / widest;
    const int width = (bits + passes - 1) / passes;
    scratch_.resize(items.size());
    for (int pass = 0; pass < passes; ++pass) {
      const int shift = pass * width;
      const std::size_t mask = (std::size_t{1} << width) - 1;
      scatter(executor, items, mask + 1, [&](const Item& item) {
        return static_cast<std::size_t>(key(item) >> shift) & mask;
      });
    }
  }

  std::size_t held_bytes() const {
    return scratch_.capacity() * sizeof(Item) + places_.capacity() * sizeof(std::uint32_t);
  }

 private:
  // Sixteen blocks of one size spread evenly over 2, 4 or 8 threads. Smaller blocks would not pay
  // for their histograms; larger ones leave the cache.
  static std::size_t block_size_of(std::size_t items) {
    return std::clamp(block_count(items, 16), std::size_t{2048}, std::size_t{8192});
  }

  template <class Digit>
  void scatter(Executor& executor, std::vector<Item>& items, std::size_t digits,
               const Digit& digit) {
    const std::size_t block_size = block_size_of(items.size());
    const std::size_t blocks = block_count(items.size(), block_size);
    places_.resize((blocks + 1) * digits);
    for_each_block(executor, items.size(), block_size,
                   [&](std::size_t block, std::size_t first, std::size_t last) {
                     std::uint32_t* counts = &places_[block * digits];
                     std::fill_n(counts, digits, 0);
                     for (std::size_t i = first; i < last; ++i) ++counts[digit(items[i])];
                   });
    // The sum runs over rows so that the compiler can vectorise it; no thread waits long for it.
    std::uint32_t* const next = &places_[blocks * digits];
    std::fill_n(next, digits, 0);
    for (std::size_t block = 0; block < blocks; ++block) {
      const std::uint32_t* counts = &places_[block * digits];
      for (std::size_t d = 0; d < digits; ++d) next[d] += counts[d];
    }
    std::uint32_t place = 0;
    for (std::size_t d = 0; d < digits; ++d) {
      if (next[d] == items.size()) return;  // one digit holds all items: nothing moves
      place += std::exchange(next[d], place);
    }
    for (std::size_t block = 0; block < blocks; ++block) {
      std::uint32_t* counts = &places_[block * digits];
      for (std::size_t d = 0; d < digits; ++d) {
        const std::uint32_t count = counts[d];
        counts[d] = next[d];
        next[d] += count;
      }
    }
    for_each_block(executor, items.size(), block_size,
                   [&](std::size_t block, std::size_t first, std::size_t last) {
                     std::uint32_t* to = &places_[block * digits];
                     for (std::size_t i = first; i < last; ++i) {
                       scratch_[to[digit(items[i])]++] = items[i];
                     }
                   });
    items.swap(scratch_);
  }

  std::vector<Item> scratch_;
  // [block][digit]: first the count, then the place of the next item. The last row sums all blocks.
  std::vector<std::uint32_t> places_;
};

}  // namespace touchstone
