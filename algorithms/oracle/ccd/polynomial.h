// Part of the oracle: polynomials of degree up to three or six with integer coefficients, and signs of
// them on dyadic intervals. Included by the files of this folder.
#pragma once

#include <array>
#include <span>

#include "algorithms/oracle/numbers/integer.h"

namespace touchstone::oracle::ccd {

// sum coefficient[i] t^i. The last coefficient up to the degree is not zero; degree -1 is zero.
template <int most>
struct Polynomial {
  std::array<Integer, most + 1> coefficient;
  int degree = -1;

  bool is_zero() const { return degree < 0; }
};

// Contacts need cubics (contact_polynomials.h), distances sextics (separation_polynomials.h). Templates
// are instantiated for both.
using Cubic = Polynomial<3>;
using Sextic = Polynomial<6>;

// Sets the degree to that of the last coefficient that is not zero.
template <int most>
void trim(Polynomial<most>& p, int at_most);

// The polynomial sum a[i] t^i (1 - t)^(n - i), for n + 1 coefficients, n <= 3.
Cubic polynomial_of(std::span<const Integer> a);

// The greatest common divisor, up to a factor. Of zero and p it is p.
template <int most>
Polynomial<most> common_divisor(const Polynomial<most>& p, const Polynomial<most>& q);
// A polynomial with the same roots, each once.
template <int most>
Polynomial<most> square_free(const Polynomial<most>& p);

// The open interval from numerator / 2^power to (numerator + 1) / 2^power, or the point where it
// begins.
struct Cell {
  Integer numerator = 0;
  int power = 0;
  bool is_point = false;
};
Cell first_half(const Cell& cell);
Cell second_half(const Cell& cell);
Cell middle(const Cell& cell);  // the point

// The value where the cell begins, times 2^(degree power).
template <int most>
Integer value_at(const Polynomial<most>& p, const Cell& cell);
template <int most>
int sign_at(const Polynomial<most>& p, const Cell& point) {
  return value_at(p, point).sign();
}

// The Bernstein coefficients on an open interval, times one positive factor.
template <int most>
struct Restriction {
  std::array<Integer, most + 1> bernstein;
  int degree;

  // The number of changes of sign: the number of roots in the interval, or greater by an even
  // number; where it is 0 or 1 it is the number of roots.
  int changes() const;
  // 1 or -1 if the polynomial has this sign on the interval for certain, else 0.
  int sign() const;
};
template <int most>
Restriction<most> restricted(const Polynomial<most>& p, const Cell& cell);

}  // namespace touchstone::oracle::ccd
