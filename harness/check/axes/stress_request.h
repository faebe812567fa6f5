// The request of a stress sweep: a check whose regimes are values of axes.
#pragma once

#include <cstddef>
#include <vector>

#include "harness/check/axes/axes.h"
#include "harness/check/check_request.h"

namespace touchstone::check {

// `cases` are those of each cell; `time_limit` is of the processor's time. `regimes`, `broad` and
// `seconds` are not read: as_check() fills in the first.
struct StressRequest : CheckRequest {
  std::vector<StressCell> cells;

  StressRequest() {
    cases = 48;
    time_limit = 0.5;
  }
  // The check whose regimes are the cells'. It is valid as long as this.
  CheckRequest as_check() const {
    CheckRequest check = *this;
    check.regimes.clear();
    for (const StressCell& cell : cells) check.regimes.push_back(&cell.regime);
    return check;
  }
};

// After so many crashes or hangs of an algorithm in a cell the rest of the cell is skipped.
inline constexpr std::size_t most_lost = 3;

}  // namespace touchstone::check
