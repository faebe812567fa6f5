// The request of a stress sweep: a check whose regimes are values of axes.
#pragma once

#include <cstddef>
#include <vector>

#include "harness/check/axes/axes.h"
#include "harness/check/check_request.h"

namespace touchstone::check {

// `cases` is the number in each cell; `time_limit` is processor time. `regimes`, `broad` and
// `seconds` are not read: as_check() fills in `regimes`. The families are values of axes too, for the
// contestants of their kinds: their jobs come after those of the cells.
struct StressRequest : CheckRequest {
  std::vector<StressCell> cells;

  StressRequest() {
    cases = 48;
    time_limit = 0.5;
  }
  std::size_t job_count() const { return cells.size() + families.size(); }
  // Returns the check whose regimes are the cells'. It is valid as long as this request.
  CheckRequest as_check() const {
    CheckRequest check = *this;
    check.regimes.clear();
    for (const StressCell& cell : cells) check.regimes.push_back(&cell.regime);
    return check;
  }
};

// The rest of a cell is skipped after this many crashes or hangs of an algorithm and task.
inline constexpr std::size_t most_lost = 3;

}  // namespace touchstone::check
