// The places of bodies, and of parts within bodies, in scene files.
#pragma once

#include "algorithms/core/pose.h"
#include "harness/files/toml_table.h"

namespace touchstone::scene {

// Reads `translation`, and `rotation` (nine numbers, row by row) or `quaternion_wxyz`; each may be
// left out. A matrix is used as given if it is a rotation to a thousandth. Throws InputError.
Pose read_pose(files::TomlTable& table);

}  // namespace touchstone::scene
