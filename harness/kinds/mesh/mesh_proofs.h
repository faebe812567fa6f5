// Certificates of pairs of bodies, convex or not.
#pragma once

#include <vector>

#include "algorithms/concave_phase.h"
#include "harness/files/concave/concave_cases.h"
#include "harness/kinds/questions.h"

namespace touchstone::kinds {

// What proves the exact answer of each case.
Proving parts_proving(ConcaveTask task, std::vector<files::ConcaveCase> cases);

}  // namespace touchstone::kinds
