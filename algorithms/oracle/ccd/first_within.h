// Part of the oracle: whether and when two moving features first come within a distance of each other,
// exactly. Included by exact_ccd.cpp, by checks and by tests.
#pragma once

#include <optional>

#include "algorithms/oracle/ccd/first_contact.h"

namespace touchstone::oracle::ccd {

using WithinTime = Root<6>;

// The first time in [0, 1] at which the closed features are no further apart than the separation
// (metres, finite, >= 0; 0: contact); nothing if there is none. There is no tolerance and no rounding.
// It takes 0.05 to 2 ms for doubles of about one size, and up to a second where they are from the whole
// range.
std::optional<WithinTime> first_within(const MovingFeatures& features, double separation);

// The same answer in doubles, as impact_of.
Impact impact_within(const MovingFeatures& features, double separation);

}  // namespace touchstone::oracle::ccd
