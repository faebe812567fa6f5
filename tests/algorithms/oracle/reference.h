// Exact answers by other ways than the oracle's, slow and simple: what its own are compared with.
// They share no code with it or with its certificates' checker.
#pragma once

#include <gmpxx.h>

#include <array>
#include <vector>

#include "algorithms/core/outcome.h"
#include "algorithms/oracle/numbers/signed_root.h"
#include "algorithms/oracle/solid.h"

namespace touchstone::oracle::reference {

using Point = std::array<mpz_class, 3>;

// The vertices of two polytopes' cores in the world, times the one number that makes integers of
// all of them, in metres / unit.
struct IntegerPair {
  std::vector<Point> a, b;
  mpq_class unit;   // metres
  mpq_class radii;  // metres: the sum of both
};
IntegerPair integer_pair(const Body& a, const Body& b);

// x * |x| of a signed distance x in square metres, which orders as x does.
using SignedSquare = mpq_class;

// The separation of the cores by separating axes: every direction that can be normal to a face of
// the difference of the two sets of points, and so to two segments between points of one set. A
// flat difference is treated in its own plane or line. The time grows with the fifth power of the
// number of points.
struct Separation {
  Answer answer = Answer::unknown;
  SignedSquare depth;  // overlapping: the signed square of minus the depth
};
Separation separate(const IntegerPair& pair);

// The squared distance of the cores, by CGAL's quadratic program; zero where they meet. Only where
// TOUCHSTONE_CGAL is defined.
SignedSquare squared_distance(const IntegerPair& pair);

// The bodies' answer where the cores' signed square is this.
Answer answer_of(const SignedSquare& cores, const mpq_class& radii);

SignedSquare signed_square(const SignedRoot& root);

}  // namespace touchstone::oracle::reference
