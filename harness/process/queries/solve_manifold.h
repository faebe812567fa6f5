// Finds the contact manifold of one case.
#pragma once

#include "algorithms/registry.h"
#include "harness/files/cases.h"

namespace touchstone::process {

// Returns the manifold in the case's own order. The algorithm is made for the query and given the
// two shapes alone. The entry must be built and take such pairs.
Manifold solve_manifold(const ManifoldEntry& entry, const ManifoldSettings& settings,
                        const files::Case& c);

}  // namespace touchstone::process
