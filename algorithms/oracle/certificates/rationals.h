// Rational numbers and vectors of them, in which certificates are checked; nothing here is shared
// with the arithmetic that makes them. All exact but for one bound.
#pragma once

#include <gmpxx.h>

#include <array>
#include <compare>
#include <string>

#include "algorithms/oracle/certificates/certificate.h"

namespace touchstone::oracle {

// Thrown where a certificate, or what it is of, does not hold.
struct Fault {
  std::string reason;
};
void require(bool holds, const char* otherwise);

// Throw Fault where a number is not finite.
mpq_class rational(long double x);
mpq_class rational(const Integer& x);

using RationalVector = std::array<mpq_class, 3>;

template <class Three>
RationalVector rational_vector(const Three& v) {
  return {rational(v[0]), rational(v[1]), rational(v[2])};
}

mpq_class dot(const RationalVector& u, const RationalVector& v);
RationalVector cross(const RationalVector& u, const RationalVector& v);
RationalVector operator+(const RationalVector& u, const RationalVector& v);
RationalVector operator-(const RationalVector& u, const RationalVector& v);
RationalVector operator*(const mpq_class& s, const RationalVector& v);
bool is_zero(const RationalVector& v);

// At least the root of x >= 0, too great by less than 2^-bits over the denominator of x; the root
// itself where it is rational.
mpq_class root_above(const mpq_class& x, mp_bitcnt_t bits);

// Of a length x, the rational x * |x|, which orders as the lengths do; or infinitely long.
struct SignedSquare {
  int infinite = 0;  // its sign
  mpq_class square = {};

  friend std::strong_ordering operator<=>(const SignedSquare& x, const SignedSquare& y) {
    if (x.infinite != y.infinite) return x.infinite <=> y.infinite;
    return cmp(x.square, y.square) <=> 0;
  }
};

// Of the length x / sqrt(square).
SignedSquare quotient(const mpq_class& x, const mpq_class& square);

// Throws Fault where it is no number.
SignedSquare signed_square(const SignedRoot& x);

}  // namespace touchstone::oracle
