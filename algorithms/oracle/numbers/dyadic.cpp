// Rounds integers times powers of two to doubles.
#include "algorithms/oracle/numbers/dyadic.h"

#include <algorithm>

namespace touchstone::oracle {
namespace {

// Rounds mantissa * 2^exponent for a mantissa >= 0.
double round(const Integer& mantissa, long exponent, bool up) {
  if (mantissa.is_zero()) return 0;
  constexpr long least_exponent = -1074;  // exponent of a subnormal double's last place
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

Scaled scaled(const Integer& x) {
  if (x.is_zero()) return {0, 0};
  const Integer magnitude = abs(x);
  const long bits = static_cast<long>(msb(magnitude)) + 1;
  const long drop = std::max(bits - 60, 0L);
  const auto top = Integer(magnitude >> drop).convert_to<std::uint64_t>();
  const double mantissa = std::ldexp(static_cast<double>(top), static_cast<int>(drop - bits));
  return {x < 0 ? -mantissa : mantissa, bits};
}

double round_down(const Integer& mantissa, long exponent) {
  return mantissa < 0 ? -round(-mantissa, exponent, true) : round(mantissa, exponent, false);
}

double round_up(const Integer& mantissa, long exponent) {
  return mantissa < 0 ? -round(-mantissa, exponent, false) : round(mantissa, exponent, true);
}

}  // namespace touchstone::oracle
