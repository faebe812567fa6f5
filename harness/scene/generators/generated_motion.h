// Options of every generated scene: displacement per frame, order of ids, and bodies that jump,
// arrive and leave.
#pragma once

#include "harness/files/toml_table.h"
#include "harness/scene/generators/generators.h"
#include "harness/scene/scene.h"

namespace touchstone::scene {

// Reads `step`, an alternative to `speed`: the greatest displacement per frame as a share of the
// bodies' median size (the longest side of a body's box in its own frame). The scene must have its
// time step already.
void read_step(files::TomlTable& table, Scene& scene);

// Reads `shuffled`, which puts ids in random order. Algorithms gain from ids that follow places.
void read_order(GeneratorInput& input, Scene& scene);

// Reads `teleports` and `churn`, shares of the moving bodies (Motion), and adds the bodies that
// arrive at frame 1: copies of random ones.
void read_exchange(GeneratorInput& input, Scene& scene);

}  // namespace touchstone::scene
