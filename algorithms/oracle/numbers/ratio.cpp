// Rounds a fraction once, as IEEE 754 rounds a quotient.
#include "algorithms/oracle/numbers/ratio.h"

#include <algorithm>
#include <cmath>

namespace touchstone::oracle {
namespace {

long bits_of(const Integer& x) { return static_cast<long>(msb(x)) + 1; }

}  // namespace

NearestDouble nearest_double(const Integer& numerator, const Integer& denominator) {
  if (numerator.is_zero()) return {};
  constexpr long digits = 53, least_exponent = -1074;
  const Integer magnitude = abs(numerator);
  // The quotient has two digits or three more than a double, and what is left over is not zero if
  // there are more.
  const long shift = digits + 2 + bits_of(denominator) - bits_of(magnitude);
  const Integer above = shift > 0 ? Integer(magnitude << shift) : magnitude;
  const Integer below = shift < 0 ? Integer(denominator << -shift) : denominator;
  Integer quotient, rest;
  divide_qr(above, below, quotient, rest);

  const long bits = bits_of(quotient);
  const long drop = std::max(bits - digits, least_exponent + shift);
  if (drop > bits) return {numerator < 0 ? -0.0 : 0.0, false};  // less than half the least double
  Integer kept = quotient >> drop;
  const Integer dropped = quotient - (kept << drop);
  const Integer half = Integer(1) << (drop - 1);
  const bool is_more = dropped > half || (dropped == half && !rest.is_zero());
  const bool is_tie = dropped == half && rest.is_zero();
  if (is_more || (is_tie && bit_test(kept, 0))) ++kept;
  const int exponent = static_cast<int>(std::clamp(drop - shift, -5000L, 5000L));
  const double value = std::ldexp(kept.convert_to<double>(), exponent);
  return {numerator < 0 ? -value : value, dropped.is_zero() && rest.is_zero()};
}

}  // namespace touchstone::oracle
