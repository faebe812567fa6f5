// What every generated scene may ask for on top of its generator: how far bodies move in a frame,
// the order of their ids, and bodies that jump, come and go.
#pragma once

#include "harness/files/toml_table.h"
#include "harness/scene/generators/generators.h"
#include "harness/scene/scene.h"

namespace touchstone {

// Reads `step`, which stands in for `speed`: the greatest displacement a frame as a share of the
// median size of the bodies (the longest side of a body's box in its own frame). The scene has its
// time step already.
void read_step(TomlTable& table, Scene& scene);

// Reads `shuffled`: whether ids are in random order. Algorithms gain from ids that follow places.
void read_order(GeneratorInput& input, Scene& scene);

// Reads `teleports` and `churn`, shares of the bodies that move (Motion), and adds the bodies that
// come at frame 1: copies of random ones.
void read_exchange(GeneratorInput& input, Scene& scene);

}  // namespace touchstone
