// What threads bring, in cells that differ in them alone.
#pragma once

#include <span>
#include <vector>

#include "harness/stats/cells/cell_times.h"

namespace touchstone::stats {

// A row for each algorithm that is right and was timed in a cell whose name ends with "2 threads", or more, and in
// the cell of the same name for one. These share their squares.
std::vector<CellSpeedUpRow> cell_speed_ups(std::span<const CellTimes> cells);

}  // namespace touchstone::stats
