// Part of the oracle: polynomials with integer coefficients.
#include "algorithms/oracle/ccd/polynomial.h"

#include <cstddef>
#include <utility>

namespace touchstone::oracle::ccd {
namespace {

// Sets the degree to that of the last coefficient that is not zero.
void trim(Polynomial& p, int at_most) {
  p.degree = at_most;
  while (p.degree >= 0 && p.coefficient[static_cast<std::size_t>(p.degree)].is_zero()) --p.degree;
}

const Integer& leading(const Polynomial& p) {
  return p.coefficient[static_cast<std::size_t>(p.degree)];
}

// Divides by the greatest common divisor of the coefficients, which keeps them short.
void make_primitive(Polynomial& p) {
  Integer content = abs(p.coefficient[0]);
  for (std::size_t i = 1; i < 4; ++i) content = gcd(content, p.coefficient[i]);
  if (content <= 1) return;
  for (Integer& c : p.coefficient) c /= content;
}

// Divides q into p: p times a power of q's leading coefficient is quotient * q + remainder.
struct Division {
  Polynomial quotient, remainder;
};
Division divide(const Polynomial& p, const Polynomial& q) {
  Division result{{}, p};
  Polynomial& rest = result.remainder;
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
  trim(result.quotient, 3);
  make_primitive(result.quotient);
  make_primitive(rest);
  return result;
}

constexpr int binomials[4][4] = {{1, 0, 0, 0}, {1, 1, 0, 0}, {1, 2, 1, 0}, {1, 3, 3, 1}};

}  // namespace

Polynomial polynomial_of(std::span<const Integer> a) {
  // (1 - t)^m has the coefficients binomial(m, k) (-1)^k.
  Polynomial p;
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

Polynomial common_divisor(const Polynomial& p, const Polynomial& q) {
  Polynomial a = p, b = q;
  make_primitive(a);
  make_primitive(b);
  while (!b.is_zero()) a = std::exchange(b, divide(a, b).remainder);
  return a;
}

Polynomial square_free(const Polynomial& p) {
  if (p.degree < 2) return p;
  Polynomial slope;
  for (std::size_t i = 1; i <= static_cast<std::size_t>(p.degree); ++i) {
    slope.coefficient[i - 1] = static_cast<int>(i) * p.coefficient[i];
  }
  trim(slope, p.degree - 1);
  const Polynomial shared = common_divisor(p, slope);
  return shared.degree < 1 ? p : divide(p, shared).quotient;
}

Cell first_half(const Cell& cell) { return {cell.numerator << 1, cell.power + 1, false}; }
Cell second_half(const Cell& cell) { return {(cell.numerator << 1) + 1, cell.power + 1, false}; }
Cell middle(const Cell& cell) { return {(cell.numerator << 1) + 1, cell.power + 1, true}; }

Integer value_at(const Polynomial& p, const Cell& point) {
  Integer value = 0;
  int shift = 0;
  for (int i = p.degree; i >= 0; --i, shift += point.power) {
    value = value * point.numerator + (p.coefficient[static_cast<std::size_t>(i)] << shift);
  }
  return value;
}

int Restriction::changes() const {
  int count = 0, last = 0;
  for (int i = 0; i <= degree; ++i) {
    const int sign = bernstein[static_cast<std::size_t>(i)].sign();
    if (sign == 0) continue;
    if (last != 0 && sign != last) ++count;
    last = sign;
  }
  return count;
}

int Restriction::sign() const {
  if (changes() > 0) return 0;
  for (int i = 0; i <= degree; ++i) {
    const int sign = bernstein[static_cast<std::size_t>(i)].sign();
    if (sign != 0) return sign;
  }
  return 0;
}

Restriction restricted(const Polynomial& p, const Cell& cell) {
  const auto n = static_cast<std::size_t>(p.degree);
  // q(x) = 2^(n power) p((numerator + x) / 2^power), by Horner's scheme.
  std::array<Integer, 4> q;
  for (std::size_t i = n + 1; i-- > 0;) {
    for (std::size_t k = n - i; k > 0; --k) q[k] = q[k] * cell.numerator + q[k - 1];
    q[0] = q[0] * cell.numerator + (p.coefficient[i] << static_cast<int>(n - i) * cell.power);
  }
  // The Bernstein coefficient i is sum over k of binomial(i, k) / binomial(n, k) q[k]; three times it
  // is an integer for n <= 3, and twice it for n = 2: six serves all.
  Restriction result{{}, p.degree};
  for (std::size_t i = 0; i <= n; ++i) {
    for (std::size_t k = 0; k <= i; ++k) {
      result.bernstein[i] += binomials[i][k] * (6 / binomials[n][k]) * q[k];
    }
  }
  return result;
}

}  // namespace touchstone::oracle::ccd
