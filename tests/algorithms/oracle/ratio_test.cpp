#include "algorithms/oracle/numbers/ratio.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "algorithms/oracle/numbers/dyadic.h"
#include "tests/algorithms/one_in.h"
#include "tests/algorithms/random.h"

namespace touchstone::oracle {
namespace {

struct Fraction {
  Integer numerator, denominator;
};

Fraction fraction_of(double x) {
  const Dyadic parts = dyadic(x);
  if (parts.mantissa.is_zero()) return {0, 1};
  if (parts.exponent < 0) return {parts.mantissa, Integer(1) << -parts.exponent};
  return {parts.mantissa << parts.exponent, 1};
}

// The sign of x - y.
int order(const Fraction& x, const Fraction& y) {
  return Integer(x.numerator * y.denominator - y.numerator * x.denominator).sign();
}

Fraction middle(double low, double high) {
  const Fraction x = fraction_of(low), y = fraction_of(high);
  return {x.numerator * y.denominator + y.numerator * x.denominator,
          2 * x.denominator * y.denominator};
}

bool is_even(double x) { return (std::bit_cast<std::uint64_t>(x) & 1U) == 0; }

// The fraction lies between the middles to both neighbours, on one only if the double is even.
void expect_nearest(const Fraction& x) {
  const NearestDouble found = nearest_double(x.numerator, x.denominator);
  ASSERT_TRUE(std::isfinite(found.value));
  EXPECT_EQ(found.is_exact, order(x, fraction_of(found.value)) == 0);
  const double infinity = std::numeric_limits<double>::infinity();
  const double low = std::nextafter(found.value, -infinity);
  const double high = std::nextafter(found.value, infinity);
  const int above_low = std::isinf(low) ? 1 : order(x, middle(low, found.value));
  const int below_high = std::isinf(high) ? 1 : -order(x, middle(found.value, high));
  ASSERT_GE(above_low, is_even(found.value) ? 0 : 1) << found.value;
  ASSERT_GE(below_high, is_even(found.value) ? 0 : 1) << found.value;
}

Integer drawn_integer(touchstone::reference::Random& random, int bits) {
  Integer x = 1;
  for (int k = 1; k < bits; ++k) x = 2 * x + random.below(2);
  return random.below(4) == 0 ? Integer(Integer(1) << bits) : x;
}

TEST(Ratio, RandomFractionsAreRoundedToTheNearest) {
  touchstone::reference::Random random(5);
  int exact = 0;
  for (int i = 0; i < drawn(4000, 400); ++i) {
    const Fraction x = {drawn_integer(random, 1 + random.below(900)),
                        drawn_integer(random, 1 + random.below(900))};
    expect_nearest(x);
    expect_nearest({-x.numerator, x.denominator});
    if (HasFatalFailure()) return;
    exact += nearest_double(x.numerator, x.denominator).is_exact ? 1 : 0;
  }
  EXPECT_GT(exact, 0);
}

// Doubles of every size, subnormal ones too, and the middles between them, times any factor.
TEST(Ratio, DoublesStayAndMiddlesBecomeEven) {
  touchstone::reference::Random random(6);
  for (int exponent = -1074; exponent < 1023; exponent += 3) {
    const double x = std::ldexp(random.uniform(0.5, 1), exponent);
    if (x == 0) continue;
    const double next = std::nextafter(x, 2 * x);
    const Integer factor = drawn_integer(random, 1 + random.below(200));
    for (Fraction fraction : {fraction_of(x), middle(x, next)}) {
      fraction.numerator *= factor;
      fraction.denominator *= factor;
      expect_nearest(fraction);
      for (const int beside : {-1, 1}) {
        expect_nearest({fraction.numerator * 1000 + beside, fraction.denominator * 1000});
      }
      if (HasFatalFailure()) return;
    }
    const Fraction own = fraction_of(x);
    EXPECT_EQ(nearest_double(own.numerator * factor, own.denominator * factor).value, x);
  }
}

TEST(Ratio, AtTheEndsOfTheRange) {
  const double least = std::numeric_limits<double>::denorm_min();
  const double most = std::numeric_limits<double>::max();
  const Integer tiny = Integer(1) << 1075;  // its reciprocal is half the least double
  EXPECT_EQ(nearest_double(1, tiny).value, 0);
  EXPECT_FALSE(nearest_double(1, tiny).is_exact);
  EXPECT_EQ(nearest_double(1001, tiny * 1000).value, least);
  EXPECT_EQ(nearest_double(-1, tiny * tiny).value, 0);
  const Integer top = Integer(1) << 1024, half_a_step = Integer(1) << 970;
  EXPECT_EQ(nearest_double(top - half_a_step - 1, 1).value, most);
  EXPECT_FALSE(nearest_double(top - half_a_step - 1, 1).is_exact);
  EXPECT_EQ(nearest_double(half_a_step - top, 1).value, -std::numeric_limits<double>::infinity());
  const Integer huge = pow(Integer(10), 400);
  EXPECT_EQ(nearest_double(2 * huge, huge).value, 2);
  EXPECT_TRUE(nearest_double(2 * huge, huge).is_exact);
  EXPECT_EQ(nearest_double(huge, 3 * huge).value, 1.0 / 3);
  EXPECT_EQ(nearest_double(0, huge).value, 0);
}

}  // namespace
}  // namespace touchstone::oracle
