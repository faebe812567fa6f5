// What broad phases keep, frame by frame: cells, nodes, intervals.
#pragma once

#include <vector>

#include "algorithms/registry.h"
#include "harness/files/json_line.h"
#include "harness/measure/phases/block_input.h"

namespace touchstone::report {

// Appends the least and the greatest corner.
void append(std::vector<float>& numbers, const Aabb& box);

// Runs each broad phase on all frames. Those that have nothing to show are left out.
files::OrderedJson structure_views(const measure::BlockInput& input,
                                   const std::vector<const BroadPhaseEntry*>& broad);

}  // namespace touchstone::report
