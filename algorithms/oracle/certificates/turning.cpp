// Rodrigues' formula, whose coefficients are power series in the square of the angle: no root is needed.
#include "algorithms/oracle/certificates/turning.h"

namespace touchstone::oracle {
namespace {

// To the next multiple of 2^-bits towards minus infinity.
mpq_class rounded(const mpq_class& x, mp_bitcnt_t bits) {
  mpz_class whole;
  const mpz_class scaled = x.get_num() << bits;
  mpz_fdiv_q(whole.get_mpz_t(), scaled.get_mpz_t(), x.get_den_mpz_t());
  mpq_class result(whole, mpz_class(1) << bits);
  result.canonicalize();
  return result;
}

struct Series {
  mpq_class sum, error;
};

// The sum over k of (-square)^k / (2 k + first)!, with first = 1 or 2.
Series series(const mpq_class& square, unsigned first) {
  constexpr mp_bitcnt_t bits = 1800;  // terms are up to e^1000 great
  const mpq_class unit(1, mpz_class(1) << bits);
  mpq_class term = first == 1 ? mpq_class(1) : mpq_class(1, 2);
  mpq_class sum = 0, error = 0, term_error = 0;
  for (unsigned k = 0;; ++k) {
    sum += k % 2 == 0 ? term : mpq_class(-term);
    error += term_error;
    const unsigned n = 2 * k + first;
    const mpq_class factor = square / ((n + 1) * (n + 2));
    term = rounded(term * factor, bits);
    term_error = term_error * factor + unit;
    term_error = rounded(term_error, bits) + unit;
    // The factors fall, so that what is left is at most twice the next term once they are below a half.
    if (2 * factor < 1 && term < mpq_class(1, mpz_class(1) << 220)) {
      return {sum, error + 2 * (term + term_error)};
    }
  }
}

}  // namespace

EnclosedRotation rotation_by(const RationalVector& w) {
  constexpr mp_bitcnt_t bits = 200;
  const mpq_class square = dot(w, w);
  require(square <= 1'000'000, "a body turns by more than 1,000 radians");
  const Series sine = series(square, 1), versine = series(square, 2);
  // exp(w) = 1 + sine [w] + versine [w]^2, and [w]^2 = w w^T - |w|^2.
  EnclosedRotation turn;
  const RationalMatrix across = {RationalVector{0, -w[2], w[1]}, RationalVector{w[2], 0, -w[0]},
                                 RationalVector{-w[1], w[0], 0}};
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      mpq_class entry = sine.sum * across[i][k] + versine.sum * w[i] * w[k];
      if (i == k) entry += 1 - versine.sum * square;
      turn.rows[i][k] = rounded(entry, bits);
    }
  }
  // No entry of [w] is above the root of the square, and none of [w]^2 above the square.
  turn.error = mpq_class(1, mpz_class(1) << bits) + sine.error * root_above(square, 64) +
               versine.error * square;
  return turn;
}

}  // namespace touchstone::oracle
