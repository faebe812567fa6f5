#include "algorithms/oracle/dyadic.h"

#include <algorithm>

namespace touchstone::oracle {
namespace {

// Of a number >= 0.
double round(const Integer& mantissa, long exponent, bool up) {
  if (mantissa.is_zero()) return 0;
  constexpr long least_exponent = -1074;  // of the last place of a subnormal double
  const long bits = static_cast<long>(msb(mantissa)) + 1;
  const long drop = std::max(bits - 53, least_exponent - exponent);
  Integer kept = mantissa;
  if (drop > 0) {
    kept = drop > bits ? Integer(0) : mantissa >> drop;
    if (up && (kept.is_zero() || (kept << drop) != mantissa)) ++kept;
    exponent += drop;
  }
  const long beyond = std::clamp(exponent, -5000L, 5000L);
  const double value = std::ldexp(kept.convert_to<double>(), static_cast<int>(beyond));
  return !up && std::isinf(value) ? std::numeric_limits<double>::max() : value;
}

}  // namespace

double round_down(const Integer& mantissa, long exponent) {
  return mantissa < 0 ? -round(-mantissa, exponent, true) : round(mantissa, exponent, false);
}

double round_up(const Integer& mantissa, long exponent) {
  return mantissa < 0 ? -round(-mantissa, exponent, false) : round(mantissa, exponent, true);
}

}  // namespace touchstone::oracle
