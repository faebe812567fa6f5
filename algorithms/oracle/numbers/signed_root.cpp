// Exact comparison of signed roots, and their rounding to doubles.
#include "algorithms/oracle/numbers/signed_root.h"

#include <algorithm>
#include <limits>

#include "algorithms/oracle/numbers/dyadic.h"
#include "algorithms/oracle/numbers/square_root.h"

namespace touchstone::oracle {
namespace {

std::strong_ordering order(const Integer& x, const Integer& y) {
  const int sign = x.compare(y);
  return sign < 0   ? std::strong_ordering::less
         : sign > 0 ? std::strong_ordering::greater
                    : std::strong_ordering::equal;
}

std::strong_ordering reversed(std::strong_ordering o) { return 0 <=> o; }

// The sum of two radii: mantissa * 2^exponent.
struct Sum {
  Integer mantissa;
  int exponent;
};
Sum sum(double radius_a, double radius_b) {
  const Dyadic a = dyadic(radius_a), b = dyadic(radius_b);
  const int exponent = std::min(a.exponent, b.exponent);
  return {a.over_power(exponent) + b.over_power(exponent), exponent};
}

}  // namespace

DoubleBounds round_less(const SignedRoot& value, double radius_a, double radius_b) {
  if (value.is_infinite()) {
    const double infinite = value.sign * std::numeric_limits<double>::infinity();
    return {infinite, infinite};
  }
  const Sum radius = sum(radius_a, radius_b);
  // The root as an integer over 2^-shift: at least 64 bits, and 200 below the radius's first bit.
  // The shift grows if the radius cancels so much of the root that these bits do not determine the
  // double.
  long shift = 0;
  if (value.sign != 0) {
    const long bits =
        static_cast<long>(msb(value.numerator)) - static_cast<long>(msb(value.denominator));
    shift = std::max(shift, 66 - bits / 2);
  }
  if (!radius.mantissa.is_zero()) {
    const long first = static_cast<long>(msb(radius.mantissa)) + radius.exponent;
    shift = std::max({shift, 200 - first, -static_cast<long>(radius.exponent)});
  }
  for (;; shift = 2 * shift + 64) {
    Integer whole = 0;
    bool exact = true;
    if (value.sign != 0) {
      Integer square, rest;
      divide_qr(Integer(value.numerator << (2 * shift)), value.denominator, square, rest);
      whole = root_below(square);
      exact = rest.is_zero() && whole * whole == square;
    }
    // sign * root is between `whole` and the next integer away from zero.
    Integer low = value.sign < 0 ? -whole : whole, high = low;
    if (!exact) (value.sign < 0 ? low -= 1 : high += 1);
    if (!radius.mantissa.is_zero()) {
      const Integer r = radius.mantissa << (radius.exponent + shift);
      low -= r;
      high -= r;
    }
    const DoubleBounds bounds = {round_down(low, -shift), round_up(high, -shift)};
    // If both integers have the same neighbouring doubles, so has the number between them.
    if (exact || (round_down(high, -shift) == bounds.low && round_up(low, -shift) == bounds.high)) {
      return bounds;
    }
  }
}

std::strong_ordering operator<=>(const SignedRoot& x, const SignedRoot& y) {
  if (x.sign != y.sign) return x.sign <=> y.sign;
  if (x.sign == 0) return std::strong_ordering::equal;
  const auto magnitude = x.is_infinite() || y.is_infinite()
                             ? x.is_infinite() <=> y.is_infinite()
                             : order(x.numerator * y.denominator, y.numerator * x.denominator);
  return x.sign > 0 ? magnitude : reversed(magnitude);
}

bool operator==(const SignedRoot& x, const SignedRoot& y) { return (x <=> y) == 0; }

std::strong_ordering compare(const SignedRoot& value, double radius_a, double radius_b) {
  const Sum radius = sum(radius_a, radius_b);
  const int radius_sign = radius.mantissa.is_zero() ? 0 : 1;
  if (value.sign != radius_sign) return value.sign <=> radius_sign;
  if (value.sign == 0) return std::strong_ordering::equal;
  if (value.is_infinite()) return std::strong_ordering::greater;
  Integer left = value.numerator;
  Integer right = radius.mantissa * radius.mantissa * value.denominator;
  const long power = 2L * radius.exponent;
  if (power >= 0) {
    right <<= power;
  } else {
    left <<= -power;
  }
  return order(left, right);
}

}  // namespace touchstone::oracle
