// Part of the oracle: floating-point numbers as integers times powers of two.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "algorithms/oracle/numbers/integer.h"

namespace touchstone::oracle {

// mantissa * 2^exponent. The mantissa is odd, or zero with a very great exponent.
struct Dyadic {
  static constexpr int of_zero = std::numeric_limits<int>::max() / 4;

  Integer mantissa = 0;
  int exponent = of_zero;

  // The number divided by 2^e, for e <= exponent.
  Integer over_power(int e) const {
    return mantissa.is_zero() ? Integer(0) : mantissa << (exponent - e);
  }
};

// Exact for finite numbers of up to 64 bits. 0 for NaN, which whoever checks a proof refuses afterwards.
template <class Scalar>
Dyadic dyadic(Scalar x) {
  static_assert(std::numeric_limits<Scalar>::radix == 2 &&
                std::numeric_limits<Scalar>::digits <= 64);
  if (x == 0) return {};
  int exponent = 0;
  std::uint64_t bits = 0;
  if (std::is_same_v<Scalar, double> && std::abs(x) >= std::numeric_limits<Scalar>::min()) {
    const auto stored = std::bit_cast<std::uint64_t>(static_cast<double>(x));
    bits = (stored & 0xfffffffffffffu) | 0x10000000000000u;
    exponent = static_cast<int>(stored >> 52 & 0x7ffu) - 1075;
  } else {
    const Scalar fraction = std::frexp(x < 0 ? -x : x, &exponent);
    if (!(fraction < 1)) return {};
    bits = static_cast<std::uint64_t>(std::ldexp(fraction, 64));
    exponent -= 64;
  }
  const int zeros = std::countr_zero(bits);
  bits >>= zeros;
  Integer mantissa = bits;
  if (x < 0) mantissa = -mantissa;
  return {mantissa, exponent + zeros};
}

// mantissa * 2^exponent with the mantissa's magnitude in [1/2, 1), off in its last digits; 0 for 0.
struct Scaled {
  double mantissa;
  long exponent;
};
Scaled scaled(const Integer& x);

// mantissa * 2^exponent as a double, rounded towards minus infinity and plus infinity.
double round_down(const Integer& mantissa, long exponent);
double round_up(const Integer& mantissa, long exponent);

}  // namespace touchstone::oracle
