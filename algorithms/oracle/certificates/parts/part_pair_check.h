// Part of the oracle, used by the checks of certificates and by what makes them: what is proven of two parts.
#pragma once

#include "algorithms/oracle/certificates/difference.h"
#include "algorithms/oracle/certificates/parts/parts_certificate.h"
#include "algorithms/oracle/certificates/parts/placed_parts.h"

namespace touchstone::oracle {

// How far two cores, or groups of them, have to be apart along a plane's direction: by more than the radii, and by no
// less than the distance.
struct ApartBy {
  mpq_class radii;
  mpq_class distance = {};  // >= 0

  // The shadows on a line along n are `gap` / |n| apart.
  bool holds(const mpq_class& gap, const RationalVector& n) const;
};

// True if the direction's planes part the cores. Throws Fault if it is zero.
bool is_parted(const RationalVector& n, const RationalCore& a, const RationalCore& b,
               const ApartBy& by);

// The direction from a to b of the plane of the one of them that is a half-space. Throws Fault if none is, or
// its matrix is singular.
RationalVector own_normal(const RationalCore& a, const RationalCore& b);

// At most so far are the cores apart. Throws Fault if the points are none of theirs, or prove nothing.
SignedSquare greatest_distance(const PartsCertificate::Met& met, const RationalCore& a,
                               const RationalCore& b);

}  // namespace touchstone::oracle
