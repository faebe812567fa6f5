// A robot as a scene: its links among obstacles, a configuration a frame.
#pragma once

#include <filesystem>

#include "harness/files/toml_table.h"
#include "harness/scene/concave_shape.h"
#include "harness/scene/scene.h"

namespace touchstone::scene {

// Makes a scene of a URDF file. Each shape of a link is a body with the link's name, on a track of the robot's
// configurations; obstacles are bodies that do not move. Left out are the pairs of read_robot, and those that the
// planning scene allows. A mesh is what `use` says.
// `table` has the robot's keys (datasets/README.md), and makes them known: `srdf`, `packages`, `place`, `joints`, `held`,
// `configurations`, `obstacles`. Files are relative to the table's file. Throws InputError with file and line.
// `draws` becomes true if configurations are random, which takes the seed of `overrides`.
Scene import_robot(files::TomlTable& table, const std::filesystem::path& urdf, MeshUse use,
                   const SceneOverrides& overrides, bool& draws);

}  // namespace touchstone::scene
