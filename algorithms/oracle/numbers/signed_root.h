// Signed lengths whose squares are rational: what distances and depths of polytopes are.
#pragma once

#include <compare>

#include "algorithms/oracle/numbers/integer.h"

namespace touchstone::oracle {

// sign * sqrt(numerator / denominator), in metres. The denominator is positive, or zero for an
// infinite length; the fraction need not be in lowest terms. Sign 0: nothing, with numerator 0.
struct SignedRoot {
  int sign = 0;
  Integer numerator = 0;
  Integer denominator = 1;

  bool is_infinite() const { return denominator.is_zero(); }

  static SignedRoot infinity(int sign) { return {sign, 1, 0}; }
};

// Exact.
std::strong_ordering operator<=>(const SignedRoot& x, const SignedRoot& y);
bool operator==(const SignedRoot& x, const SignedRoot& y);

// The doubles on both sides of value - radius_a - radius_b, the same one twice where it is a
// double; and the order of value and radius_a + radius_b. Radii are finite and >= 0.
struct DoubleBounds {
  double low, high;
};
DoubleBounds round_less(const SignedRoot& value, double radius_a, double radius_b);
std::strong_ordering compare(const SignedRoot& value, double radius_a, double radius_b);

}  // namespace touchstone::oracle
