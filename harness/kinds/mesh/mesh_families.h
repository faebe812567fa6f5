// The families of pairs of bodies that need not be convex.
#pragma once

#include <span>

#include "harness/files/concave/concave_cases.h"
#include "harness/kinds/family.h"

namespace touchstone::kinds {

std::span<const DrawnFamily<files::ConcaveCase>> mesh_families();

}  // namespace touchstone::kinds
