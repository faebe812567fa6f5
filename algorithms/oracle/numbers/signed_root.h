// Part of the oracle: signed lengths whose squares are rational, such as distances and depths of
// polytopes.
#pragma once

#include <compare>

#include "algorithms/oracle/numbers/integer.h"

namespace touchstone::oracle {

// sign * sqrt(numerator / denominator), in metres. The denominator is positive, or zero for an
// infinite length. The fraction need not be in lowest terms. Sign 0 is zero, with numerator 0.
struct SignedRoot {
  int sign = 0;
  Integer numerator = 0;
  Integer denominator = 1;

  bool is_infinite() const { return denominator.is_zero(); }

  static SignedRoot infinity(int sign) { return {sign, 1, 0}; }
};

// The comparisons are exact.
std::strong_ordering operator<=>(const SignedRoot& x, const SignedRoot& y);
bool operator==(const SignedRoot& x, const SignedRoot& y);

// `round_less` returns the doubles on both sides of value - radius_a - radius_b, the same one twice
// if that is a double. `compare` orders value and radius_a + radius_b. Radii are finite and >= 0.
struct DoubleBounds {
  double low, high;
};
DoubleBounds round_less(const SignedRoot& value, double radius_a, double radius_b);
std::strong_ordering compare(const SignedRoot& value, double radius_a, double radius_b);

}  // namespace touchstone::oracle
