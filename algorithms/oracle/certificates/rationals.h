// Part of the oracle: rational numbers and vectors, in which certificates are checked. This code
// shares nothing with the arithmetic that makes them. Everything is exact except `root_above`.
#pragma once

#include <gmpxx.h>

#include <array>
#include <compare>
#include <stdexcept>

#include "algorithms/oracle/certificates/certificate.h"

namespace touchstone::oracle {

// Thrown if a certificate, or a body that it names, is invalid.
struct Fault : std::runtime_error {
  using std::runtime_error::runtime_error;
};
void require(bool holds, const char* otherwise);

// Exact. Throws Fault if the number is not finite.
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

// An upper bound on the root of x >= 0, too great by less than 2^-bits over the denominator of x.
// If the root is rational, it is returned itself.
mpq_class root_above(const mpq_class& x, mp_bitcnt_t bits);

// A length x as the rational x * |x|, which orders like the lengths, or an infinite length.
struct SignedSquare {
  int infinite = 0;  // the sign of an infinite length, else 0
  mpq_class square = {};

  friend std::strong_ordering operator<=>(const SignedSquare& x, const SignedSquare& y) {
    if (x.infinite != y.infinite) return x.infinite <=> y.infinite;
    return cmp(x.square, y.square) <=> 0;
  }
};

// The length x / sqrt(square).
SignedSquare quotient(const mpq_class& x, const mpq_class& square);

// Throws Fault if x is not a number.
SignedSquare signed_square(const SignedRoot& x);

}  // namespace touchstone::oracle
