// The bodies that a scene file lists.
#pragma once

#include <cstdint>
#include <vector>

#include "harness/scene/scene.h"
#include "harness/scene/shape_reader.h"

namespace touchstone::scene {

// Reads [shapes.NAME] and [[body]] (datasets/README.md) into the scene. Returns the line of each
// body. Throws InputError with the place.
std::vector<std::int64_t> read_bodies(files::TomlTable& table, ShapeReader& shapes, Scene& scene);

}  // namespace touchstone::scene
