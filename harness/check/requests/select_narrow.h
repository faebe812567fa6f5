// Narrow phases by their names, to be graded.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "algorithms/registry.h"

namespace touchstone::check {

// Returns the narrow phases of these names and groups. The oracle belongs to no group: it does not
// grade itself, unless it is named. Throws InputError for a name that is unknown, or that has none
// of the scalars.
std::vector<const NarrowPhaseEntry*> narrow_phases_to_grade(const std::string& names,
                                                            std::span<const Precision> scalars);

}  // namespace touchstone::check
