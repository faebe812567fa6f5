// The linear part of a body's placement, exactly.
#pragma once

#include <array>

#include "algorithms/oracle/numbers/integer.h"
#include "algorithms/oracle/solid.h"

namespace touchstone::oracle {

// columns[k][row] * 2^exponent / denominator; the denominator is 1 but for quaternions.
struct ExactMatrix {
  std::array<IntegerVector, 3> columns;
  int exponent = 0;
  Integer denominator = 1;
};

ExactMatrix exact_matrix(const Body& body);

}  // namespace touchstone::oracle
