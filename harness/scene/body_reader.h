// The bodies that a scene file lists, and the places of bodies and of parts within them.
#pragma once

#include <cstdint>
#include <vector>

#include "algorithms/core/pose.h"
#include "harness/files/toml_table.h"
#include "harness/scene/scene.h"
#include "harness/scene/shape_reader.h"

namespace touchstone::scene {

// Reads `translation`, and `rotation` (nine numbers, row by row) or `quaternion_wxyz`; each may be
// left out. A matrix is used as given if it is a rotation to a thousandth. Throws InputError.
Pose read_pose(files::TomlTable& table);

// Reads [shapes.NAME] and [[body]] (datasets/README.md) into the scene. Returns the line of each
// body, 0 of those that were there before. Throws InputError with the place.
std::vector<std::int64_t> read_bodies(files::TomlTable& table, ShapeReader& shapes, Scene& scene);

}  // namespace touchstone::scene
