// Part of the oracle: square roots of integers.
#pragma once

#include "algorithms/oracle/numbers/integer.h"

namespace touchstone::oracle {

// The greatest integer whose square is not above `square`, which is not negative. Boost's own finds one bit at a
// time.
Integer root_below(const Integer& square);

}  // namespace touchstone::oracle
