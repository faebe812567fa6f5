// Options of every generated scene: displacement per frame, order of ids, and bodies that jump,
// arrive and leave; and errors of overrides that do not apply to a scene.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

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

// Each throws InputError with the file if a user asked for what it names.
void refuse_seed(const std::string& file, std::int64_t seed);
void refuse_gap(const std::string& file, std::optional<double> gap);
void refuse_moving(const std::string& file, std::optional<double> share);
// All that only generated scenes have, but for the seed, which a listed scene's motion may have.
void refuse_for_listed(const std::string& file, const SceneOverrides& overrides);

}  // namespace touchstone::scene
