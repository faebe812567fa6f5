// Part of the oracle: a proof in doubles, over intervals of time, that two moving features miss each
// other or meet. Included by the files of this folder.
#pragma once

#include <array>
#include <cstdint>

namespace touchstone::oracle::ccd {

// The contact polynomials (contact_polynomials.h), rounded to Bernstein coefficients.
struct RoundedPolynomials {
  // The volume of degree `degree`, possibly without its roots at 0 and 1, and the greatest error of a
  // coefficient.
  int degree = 3;
  std::array<double, 4> volume{};
  double volume_error = 0;
  // For each vertex its area along one axis, negated for a vertex of the second feature, and the
  // greatest error.
  std::array<std::array<double, 3>, 4> areas{};
  double area_error = 0;
  // True for an area that is zero at all times, exactly.
  std::array<bool, 4> is_zero{};
};

enum class Proven : std::uint8_t { miss, hit, nothing };

struct IntervalProof {
  Proven proven;
  // Of a hit: the first contact is in [free_before, contact_by], at most 2^-40 wide.
  double free_before, contact_by;
};

// Says what is proven of the roots of the volume in [0, 1]; the roots that were taken out are not
// looked at.
//
// Steps: 1. Over an interval, the signs of Bernstein coefficients beyond their errors prove that the
//           volume has no root there, or that the areas have two signs that exclude contact: free.
//        2. They prove that it has a root and that all areas have the sign of contact: a hit.
//        3. Otherwise halve the interval, the earlier half first.
// Rounding: halving replaces a coefficient by means of two, at most three times; a mean has a
// relative error of u = 2^-53, so an error grows by 3 u times the greatest coefficient with each
// halving, and there are 50 at most.
IntervalProof prove_over_intervals(const RoundedPolynomials& polynomials);

}  // namespace touchstone::oracle::ccd
