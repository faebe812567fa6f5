// Part of the oracle: the linear part of a body's placement as exact integers.
#pragma once

#include <array>

#include "algorithms/oracle/numbers/integer.h"
#include "algorithms/oracle/solid.h"

namespace touchstone::oracle {

// The matrix is columns[k][row] * 2^exponent / denominator. The denominator is 1 except for
// quaternions.
struct ExactMatrix {
  std::array<IntegerVector, 3> columns;
  int exponent = 0;
  Integer denominator = 1;
};

ExactMatrix exact_matrix(const Body& body);

}  // namespace touchstone::oracle
