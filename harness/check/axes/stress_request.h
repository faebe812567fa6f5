// What a stress sweep is asked to do.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "algorithms/registry.h"
#include "harness/check/axes/axes.h"
#include "harness/check/check_request.h"

namespace touchstone {

struct StressRequest {
  std::vector<const NarrowPhaseEntry*> narrow;
  std::vector<Precision> scalars = {Precision::float64, Precision::float32};
  std::vector<StressCell> cells;
  std::uint64_t seed = 1;
  int cases = 48;           // of each cell
  int workers = 2;          // processes
  double time_limit = 0.5;  // seconds of the processor that a query may take
  std::filesystem::path out;
  bool resume = false;  // go on where the folder's last sweep ended

  // The same for what grades and shrinks the cases of a check; a cell is a regime of it. It is
  // valid as long as this.
  CheckRequest as_check() const;
};

inline CheckRequest StressRequest::as_check() const {
  CheckRequest check;
  check.narrow = narrow;
  check.scalars = scalars;
  for (const StressCell& cell : cells) check.regimes.push_back(&cell.regime);
  check.seed = seed;
  check.cases = cases;
  check.workers = workers;
  check.time_limit = time_limit;
  check.out = out;
  return check;
}

// After so many crashes or hangs of an algorithm in a cell the rest of the cell is skipped.
inline constexpr std::size_t most_lost = 3;

}  // namespace touchstone
