// Part of the oracle: a measure with the numbers that it was rounded from.
#pragma once

#include "algorithms/oracle/numbers/signed_root.h"
#include "algorithms/oracle/oracle.h"

namespace touchstone::oracle {

struct ExactMeasure : Measure {
  SignedRoot core_lower, core_upper;  // the cores' signed distance; see certificate.h
};

}  // namespace touchstone::oracle
