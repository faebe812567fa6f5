#include "algorithms/oracle/numbers/square_root.h"

#include <gtest/gtest.h>

#include "tests/algorithms/one_in.h"
#include "tests/algorithms/random.h"

namespace touchstone::oracle {
namespace {

void expect_root(const Integer& square) {
  const Integer root = root_below(square);
  ASSERT_LE(root * root, square);
  ASSERT_GT((root + 1) * (root + 1), square);
}

TEST(SquareRoot, OfSmallIntegers) {
  for (int i = 0; i < 5000; ++i) expect_root(i);
}

// Squares and their neighbours, and random numbers, of any length.
TEST(SquareRoot, IsTheGreatestThatFits) {
  touchstone::reference::Random random(3);
  for (int bits = 1; bits < 1500; bits += drawn(1, 10)) {
    Integer x = 1;
    for (int k = 1; k < bits; ++k) x = 2 * x + random.below(2);
    expect_root(x);
    for (const int beside : {-1, 0, 1}) {
      expect_root(x * x + beside);
      if (HasFatalFailure()) return;
    }
    expect_root(Integer(1) << bits);
    expect_root((Integer(1) << bits) - 1);
  }
}

}  // namespace
}  // namespace touchstone::oracle
