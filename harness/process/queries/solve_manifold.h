// The contact manifold of one case.
#pragma once

#include "algorithms/registry.h"
#include "harness/files/cases.h"

namespace touchstone::process {

// In the case's own order. The algorithm is made for the query and given the two shapes alone. The
// entry is built and takes such pairs.
Manifold solve_manifold(const ManifoldEntry& entry, const ManifoldSettings& settings,
                        const files::Case& c);

}  // namespace touchstone::process
