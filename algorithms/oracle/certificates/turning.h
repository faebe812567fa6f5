// Part of the oracle, used by cast_certificate_check alone: rotations exp(w) in rationals.
#pragma once

#include <array>

#include "algorithms/oracle/certificates/rationals.h"

namespace touchstone::oracle {

using RationalMatrix = std::array<RationalVector, 3>;  // rows

// A matrix and a bound on how far each entry of exp(w) is from its.
struct EnclosedRotation {
  RationalMatrix rows;
  mpq_class error;
};

// The power series of exp(w), rounded to some 200 bits. Throws Fault beyond 1,000 radians.
EnclosedRotation rotation_by(const RationalVector& w);

}  // namespace touchstone::oracle
