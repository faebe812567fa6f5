// Part of the oracle: polynomials with integer coefficients.
#include "algorithms/oracle/ccd/polynomial.h"

#include <cstddef>
#include <utility>

namespace touchstone::oracle::ccd {

template <int most>
void trim(Polynomial<most>& p, int at_most) {
  p.degree = at_most;
  while (p.degree >= 0 && p.coefficient[static_cast<std::size_t>(p.degree)].is_zero()) --p.degree;
}

namespace {

template <int most>
const Integer& leading(const Polynomial<most>& p) {
  return p.coefficient[static_cast<std::size_t>(p.degree)];
}

// Divides by the greatest common divisor of the coefficients, which keeps them short.
template <int most>
void make_primitive(Polynomial<most>& p) {
  Integer content = abs(p.coefficient[0]);
  for (std::size_t i = 1; i < p.coefficient.size(); ++i) content = gcd(content, p.coefficient[i]);
  if (content <= 1) return;
  for (Integer& c : p.coefficient) c /= content;
}

// Divides q into p: p times a power of q's leading coefficient is quotient * q + remainder.
template <int most>
struct Division {
  Polynomial<most> quotient, remainder;
};
template <int most>
Division<most> divide(const Polynomial<most>& p, const Polynomial<most>& q) {
  Division<most> result{{}, p};
  Polynomial<most>& rest = result.remainder;
  const Integer& lead = leading(q);
  while (rest.degree >= q.degree) {
    const auto shift = static_cast<std::size_t>(rest.degree - q.degree);
    const Integer top = leading(rest);
    for (Integer& c : rest.coefficient) c *= lead;
    for (Integer& c : result.quotient.coefficient) c *= lead;
    result.quotient.coefficient[shift] += top;
    for (std::size_t i = 0; i <= static_cast<std::size_t>(q.degree); ++i) {
      rest.coefficient[i + shift] -= top * q.coefficient[i];
    }
    trim(rest, rest.degree - 1);
  }
  trim(result.quotient, most);
  make_primitive(result.quotient);
  make_primitive(rest);
  return result;
}

constexpr int binomials[7][7] = {{1},
                                 {1, 1},
                                 {1, 2, 1},
                                 {1, 3, 3, 1},
                                 {1, 4, 6, 4, 1},
                                 {1, 5, 10, 10, 5, 1},
                                 {1, 6, 15, 20, 15, 6, 1}};

}  // namespace

Cubic polynomial_of(std::span<const Integer> a) {
  // (1 - t)^m has the coefficients binomial(m, k) (-1)^k.
  Cubic p;
  const std::size_t n = a.size() - 1;
  for (std::size_t i = 0; i <= n; ++i) {
    for (std::size_t k = 0; k + i <= n; ++k) {
      const int factor = binomials[n - i][k] * (k % 2 == 0 ? 1 : -1);
      p.coefficient[i + k] += factor * a[i];
    }
  }
  trim(p, static_cast<int>(n));
  return p;
}

template <int most>
Polynomial<most> common_divisor(const Polynomial<most>& p, const Polynomial<most>& q) {
  Polynomial<most> a = p, b = q;
  make_primitive(a);
  make_primitive(b);
  while (!b.is_zero()) a = std::exchange(b, divide(a, b).remainder);
  return a;
}

template <int most>
Polynomial<most> square_free(const Polynomial<most>& p) {
  if (p.degree < 2) return p;
  Polynomial<most> slope;
  for (std::size_t i = 1; i <= static_cast<std::size_t>(p.degree); ++i) {
    slope.coefficient[i - 1] = static_cast<int>(i) * p.coefficient[i];
  }
  trim(slope, p.degree - 1);
  const Polynomial<most> shared = common_divisor(p, slope);
  return shared.degree < 1 ? p : divide(p, shared).quotient;
}

Cell first_half(const Cell& cell) { return {cell.numerator << 1, cell.power + 1, false}; }
Cell second_half(const Cell& cell) { return {(cell.numerator << 1) + 1, cell.power + 1, false}; }
Cell middle(const Cell& cell) { return {(cell.numerator << 1) + 1, cell.power + 1, true}; }

template <int most>
Integer value_at(const Polynomial<most>& p, const Cell& point) {
  Integer value = 0;
  int shift = 0;
  for (int i = p.degree; i >= 0; --i, shift += point.power) {
    value = value * point.numerator + (p.coefficient[static_cast<std::size_t>(i)] << shift);
  }
  return value;
}

template <int most>
int Restriction<most>::changes() const {
  int count = 0, last = 0;
  for (int i = 0; i <= degree; ++i) {
    const int sign = bernstein[static_cast<std::size_t>(i)].sign();
    if (sign == 0) continue;
    if (last != 0 && sign != last) ++count;
    last = sign;
  }
  return count;
}

template <int most>
int Restriction<most>::sign() const {
  if (changes() > 0) return 0;
  for (int i = 0; i <= degree; ++i) {
    const int sign = bernstein[static_cast<std::size_t>(i)].sign();
    if (sign != 0) return sign;
  }
  return 0;
}

template <int most>
Restriction<most> restricted(const Polynomial<most>& p, const Cell& cell) {
  const auto n = static_cast<std::size_t>(p.degree);
  // q(x) = 2^(n power) p((numerator + x) / 2^power), by Horner's scheme.
  std::array<Integer, most + 1> q;
  for (std::size_t i = n + 1; i-- > 0;) {
    for (std::size_t k = n - i; k > 0; --k) q[k] = q[k] * cell.numerator + q[k - 1];
    q[0] = q[0] * cell.numerator + (p.coefficient[i] << static_cast<int>(n - i) * cell.power);
  }
  // The Bernstein coefficient i is sum over k of binomial(i, k) / binomial(n, k) q[k]. Six is a multiple
  // of all binomials of n <= 3, 60 of those of n <= 6.
  constexpr int multiple = most <= 3 ? 6 : 60;
  static_assert(most <= 6);
  Restriction<most> result{{}, p.degree};
  for (std::size_t i = 0; i <= n; ++i) {
    for (std::size_t k = 0; k <= i; ++k) {
      result.bernstein[i] += binomials[i][k] * (multiple / binomials[n][k]) * q[k];
    }
  }
  return result;
}

#define TOUCHSTONE_POLYNOMIALS(most)                                                          \
  template void trim(Polynomial<most>&, int);                                                 \
  template Polynomial<most> common_divisor(const Polynomial<most>&, const Polynomial<most>&); \
  template Polynomial<most> square_free(const Polynomial<most>&);                             \
  template Integer value_at(const Polynomial<most>&, const Cell&);                            \
  template struct Restriction<most>;                                                          \
  template Restriction<most> restricted(const Polynomial<most>&, const Cell&)
TOUCHSTONE_POLYNOMIALS(3);
TOUCHSTONE_POLYNOMIALS(6);
#undef TOUCHSTONE_POLYNOMIALS

}  // namespace touchstone::oracle::ccd
