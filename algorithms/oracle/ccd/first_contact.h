// Part of the oracle: whether and when two moving features first share a point, exactly. Included by
// exact_ccd.cpp and by tests.
#pragma once

#include <optional>

#include "algorithms/oracle/ccd/moving_features.h"
#include "algorithms/oracle/ccd/root.h"

namespace touchstone::oracle::ccd {

using ContactTime = Root<3>;

// The first time in [0, 1] at which the closed features share a point; nothing if there is none.
// There is no tolerance and no rounding; times of two queries are ordered by `compare`. 5 to 50 us.
std::optional<ContactTime> first_contact(const MovingFeatures& features);
// For a caller that has the polynomials.
std::optional<ContactTime> first_contact(const MovingFeatures& features,
                                         const IntegerPolynomials& given);

// The same answer, with the time between two doubles that are at most 2^-40 apart; they are equal
// where the time is 0 or 1. The filters may be left out, which tests do.
struct Impact {
  bool is_hit = false;
  double free_before = 1;
  double contact_by = 0;  // of a hit
};
enum class Filters { all, fixed_integers, none };
Impact impact_of(const MovingFeatures& features, Filters filters = Filters::all);

}  // namespace touchstone::oracle::ccd
