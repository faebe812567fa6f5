// One query about one case, as `query` asks it and `check` grades it.
#pragma once

#include "algorithms/registry.h"
#include "harness/io/cases.h"

namespace touchstone {

// The outcome in the case's own order, with what the task asks for and no more: an algorithm may
// know more, but then knows it by chance. The algorithm is made for the query and given the two
// shapes alone, so that no case can spoil another's answer. The entry is built and takes such
// pairs.
Outcome solve_case(const NarrowPhaseEntry& entry, const NarrowPhaseSettings& settings,
                   const Case& c, Task task);

}  // namespace touchstone
