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
    const std::size_t mask = (std::size_t{1} << width) - 1;
    // One thread needs a row for each pass and more need one for each block: what is held does not
    // depend on how many there are.
    const std::size_t rows = std::max(static_cast<std::size_t>(passes),
                                      block_count(items.size(), block_size_of(items.size())) + 1);
    places_.resize(rows * (mask + 1));
    scratch_.resize(items.size());
    const auto digit = [&](const Item& item, int pass) {
      return static_cast<std::size_t>(key(item) >> pass * width) & mask;
    };
    if (executor.width() == 1 || items.size() <= least_block) {
      return sort_alone(items, passes, mask + 1, digit);
    }
    for (int pass = 0; pass < passes; ++pass) {
      scatter(executor, items, mask + 1, [&](const Item& item) { return digit(item, pass); });
    }
  }

  std::size_t held_bytes() const {
    return scratch_.capacity() * sizeof(Item) + places_.capacity() * sizeof(std::uint32_t);
  }

 private:
  static constexpr std::size_t least_block = 2048;

  // Sixteen blocks of one size spread evenly over 2, 4 or 8 threads; four of fewer items do, which
  // else would be scattered in so short runs that threads share their cache lines. Smaller blocks
  // would not pay for their histograms; larger ones leave the cache.
  static std::size_t block_size_of(std::size_t items) {
    if (items <= 16 * least_block) return std::max(block_count(items, 4), least_block);
    return std::min(block_count(items, 16), std::size_t{8192});
  }

  // One thread counts the digits of two passes at once.
  template <class Digit>
  void sort_alone(std::vector<Item>& items, int passes, std::size_t digits, const Digit& digit) {
    std::fill_n(places_.begin(), static_cast<std::size_t>(passes) * digits, 0);
    const auto row = [&](int pass) { return &places_[static_cast<std::size_t>(pass) * digits]; };
    for (int pass = 0; pass < passes; pass += 2) {
      std::uint32_t* const counts = row(pass);
      if (pass + 1 == passes) {
        for (const Item& item : items) ++counts[digit(item, pass)];
      } else {
        for (const Item& item : items) {
          ++counts[digit(item, pass)];
          ++counts[digits + digit(item, pass + 1)];
        }
      }
    }
    for (int pass = 0; pass < passes; ++pass) {
      std::uint32_t* const next = row(pass);
      if (next[digit(items[0], pass)] == items.size()) continue;  // nothing moves
      std::uint32_t place = 0;
      for (std::size_t d = 0; d < digits; ++d) place += std::exchange(next[d], place);
      Item* const to = scratch_.data();
      for (const Item& item : items) to[next[digit(item, pass)]++] = item;
      items.swap(scratch_);
    }
  }

  template <class Digit>
  void scatter(Executor& executor, std::vector<Item>& items, std::size_t digits,
               const Digit& digit) {
    const std::size_t block_size = block_size_of(items.size());
    const std::size_t blocks = block_count(items.size(), block_size);
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
  // [block or pass][digit]: first the count, then the place of the next item. Behind the blocks' rows
  // there is one for the sum of them.
  std::vector<std::uint32_t> places_;
};

}  // namespace touchstone
