// Part of the oracle: rounds fractions of integers to doubles.
#pragma once

#include "algorithms/oracle/numbers/integer.h"

namespace touchstone::oracle {

// The double that is nearest to a fraction, the even one of two that are equally near. It is infinite
// if the fraction is beyond the range of doubles.
struct NearestDouble {
  double value = 0;
  bool is_exact = true;
};

// The denominator is positive.
NearestDouble nearest_double(const Integer& numerator, const Integer& denominator);

}  // namespace touchstone::oracle
