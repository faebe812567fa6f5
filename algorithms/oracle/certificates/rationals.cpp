// Conversions to GMP's rationals and vector arithmetic on them.
#include "algorithms/oracle/certificates/rationals.h"

#include <cmath>
#include <cstdint>
#include <iterator>
#include <vector>

namespace touchstone::oracle {

void require(bool holds, const char* otherwise) {
  if (!holds) throw Fault{otherwise};
}

mpq_class rational(long double x) {
  require(std::isfinite(x), "a number of a body or of a generator is not finite");
  int exponent = 0;
  mpq_class sum;
  for (x = std::frexp(x, &exponent); x != 0;) {  // a sum of doubles
    const auto part = static_cast<double>(x);
    sum += mpq_class(part);
    x -= part;
  }
  return exponent < 0 ? mpq_class(sum >> -exponent) : mpq_class(sum << exponent);
}

mpq_class rational(const Integer& x) {
  std::vector<std::uint64_t> parts;
  export_bits(Integer(abs(x)), std::back_inserter(parts), 64);
  mpz_class whole;
  mpz_import(whole.get_mpz_t(), parts.size(), 1, sizeof parts[0], 0, 0, parts.data());
  return x < 0 ? -whole : whole;
}

mpq_class dot(const RationalVector& u, const RationalVector& v) {
  return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}
RationalVector cross(const RationalVector& u, const RationalVector& v) {
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}
RationalVector operator+(const RationalVector& u, const RationalVector& v) {
  return {u[0] + v[0], u[1] + v[1], u[2] + v[2]};
}
RationalVector operator-(const RationalVector& u, const RationalVector& v) {
  return {u[0] - v[0], u[1] - v[1], u[2] - v[2]};
}
RationalVector operator*(const mpq_class& s, const RationalVector& v) {
  return {s * v[0], s * v[1], s * v[2]};
}
bool is_zero(const RationalVector& v) { return v[0] == 0 && v[1] == 0 && v[2] == 0; }

mpq_class root_above(const mpq_class& x, mp_bitcnt_t bits) {
  const mpz_class square = (x.get_num() * x.get_den()) << 2 * bits;
  mpz_class root = sqrt(square);
  if (root * root != square) ++root;
  mpq_class above(root, x.get_den() << bits);
  above.canonicalize();
  return above;
}

SignedSquare quotient(const mpq_class& x, const mpq_class& square) {
  return {0, x * abs(x) / square};
}

SignedSquare signed_square(const SignedRoot& x) {
  const bool one_sign = x.sign == -1 || x.sign == 1;
  require(one_sign ? x.numerator > 0 && x.denominator >= 0
                   : x.sign == 0 && x.numerator == 0 && x.denominator > 0,
          "a claimed bound is not a number");
  if (x.denominator == 0) return {x.sign};
  return {0, x.sign * rational(x.numerator) / rational(x.denominator)};
}

}  // namespace touchstone::oracle
