// Parts of the families of pairs of bodies that need not be convex.
#pragma once

#include <array>
#include <vector>

#include "harness/kinds/mesh/mesh_families.h"

namespace touchstone::kinds {

ConcaveBody triangle_body(const std::array<Vec3d, 3>& corners);

// Adds the families that are values of axes of stress.
void add_mesh_axes(std::vector<DrawnFamily<files::ConcaveCase>>& list);

}  // namespace touchstone::kinds
