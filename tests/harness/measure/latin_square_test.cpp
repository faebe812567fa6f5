// Tests of the order of contestants.
#include "harness/measure/measure_plan.h"

#include <gtest/gtest.h>

#include <set>

namespace touchstone {
namespace {

TEST(LatinSquare, EachIsOnceInEveryRoundAndEveryPosition) {
  for (std::size_t size = 1; size <= 6; ++size) {
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
      base::Random random(seed);
      const measure::LatinSquare square = measure::latin_square(size, random);
      ASSERT_EQ(square.size(), size);
      for (std::size_t i = 0; i < size; ++i) {
        std::set<std::size_t> round, position;
        for (std::size_t k = 0; k < size; ++k) {
          round.insert(square[i][k]);
          position.insert(square[k][i]);
        }
        EXPECT_EQ(round.size(), size);
        EXPECT_EQ(position.size(), size);
        EXPECT_LT(*round.rbegin(), size);
      }
    }
  }
}

TEST(LatinSquare, TheSeedDecidesAndEveryOrderComes) {
  std::set<std::vector<std::size_t>> first_rounds;
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    base::Random random(seed), again(seed);
    const measure::LatinSquare square = measure::latin_square(4, random);
    EXPECT_EQ(square, measure::latin_square(4, again));
    first_rounds.insert(square[0]);
  }
  EXPECT_EQ(first_rounds.size(), 24u);
}

}  // namespace
}  // namespace touchstone
