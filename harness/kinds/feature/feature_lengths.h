// The size of a query of continuous collision, and the lengths that it is asked with.
#pragma once

#include <cstdint>

#include "algorithms/ccd.h"
#include "algorithms/oracle/oracle.h"

namespace touchstone::kinds {

// Metres. Queries of one call have them in common.
struct Lengths {
  double tolerance = 0, separation = 0;

  bool operator==(const Lengths&) const = default;
};

inline constexpr std::uint64_t queries_of_a_call = 50;

// The size of the features (metres) of the query with this number, and its lengths without a separation.
struct CcdSize {
  double scale, tolerance;
};
CcdSize ccd_size(std::uint64_t index);

// The lengths of the query with this number where a separation counts as contact. Of every sixteenth query it is
// half the tolerance more or less than a least distance to which the features come, so that the verdict is a
// close one.
Lengths separated_lengths(std::uint64_t index, const CcdQuery& query, int first_count,
                          oracle::Oracle& oracle);

}  // namespace touchstone::kinds
