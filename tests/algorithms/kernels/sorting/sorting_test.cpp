#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

#include "algorithms/kernels/sorting/insertion_sort.h"
#include "algorithms/kernels/sorting/ordered_key.h"
#include "algorithms/kernels/sorting/radix_sort.h"

namespace touchstone {
namespace {

TEST(OrderedKey, HasTheOrderOfTheFloats) {
  constexpr float largest = std::numeric_limits<float>::max();
  constexpr float smallest = std::numeric_limits<float>::denorm_min();
  const std::vector<float> ascending = {
      -std::numeric_limits<float>::infinity(), -largest, -1, -smallest, 0, smallest, 1, largest,
      std::numeric_limits<float>::infinity()};
  for (std::size_t i = 1; i < ascending.size(); ++i) {
    EXPECT_LT(ordered_key(ascending[i - 1]), ordered_key(ascending[i])) << ascending[i];
  }
  EXPECT_EQ(ordered_key(-0.0f), ordered_key(0.0f));
}

TEST(RadixSort, IsAStableSortAtEveryWidth) {
  std::mt19937_64 random(3);
  for (const std::size_t count : {0, 1, 2, 1000, 5000, 20'000, 100'000}) {
    for (const int bits : {1, 9, 32, 60}) {
      std::vector<std::pair<std::uint64_t, std::uint32_t>> items(count);
      for (std::uint32_t i = 0; i < count; ++i) items[i] = {random() >> (64 - bits), i};
      // A digit that is the same in all is passed over.
      if (bits == 60) {
        for (auto& item : items) item.first |= 0xfff000;
      }
      auto expected = items;
      std::ranges::sort(expected);
      for (const int width : {1, 3}) {
        Executor executor(width);
        RadixSort<std::pair<std::uint64_t, std::uint32_t>> radix_sort;
        auto sorted = items;
        radix_sort(executor, sorted, bits, [](const auto& item) { return item.first; });
        EXPECT_EQ(sorted == expected, true) << count << " items, " << bits << " bits";
      }
    }
  }
}

TEST(InsertionSort, SortsOrSaysThatItGaveUp) {
  std::mt19937_64 random(4);
  int sorted = 0, gave_up = 0;
  for (int trial = 0; trial < 400; ++trial) {
    std::vector<std::uint64_t> items(random() % 2000);
    const std::uint64_t disorder = std::uint64_t{1} << (trial % 12);
    for (std::size_t i = 0; i < items.size(); ++i) items[i] = i + random() % disorder;
    auto expected = items;
    std::ranges::sort(expected);
    if (insertion_sort(std::span(items), 4)) {
      EXPECT_EQ(items, expected);
      ++sorted;
    } else {
      std::ranges::sort(items);
      EXPECT_EQ(items, expected) << "an item was lost";
      ++gave_up;
    }
  }
  EXPECT_GT(sorted, 100);
  EXPECT_GT(gave_up, 100);
}

}  // namespace
}  // namespace touchstone
