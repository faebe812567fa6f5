// Errors of overrides that do not apply to a scene.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "harness/scene/scene.h"

namespace touchstone::scene {

// Each throws InputError with the file if a user asked for what it names.
void refuse_seed(const std::string& file, std::int64_t seed);
void refuse_gap(const std::string& file, std::optional<double> gap);
void refuse_moving(const std::string& file, std::optional<double> share);
// All that only generated scenes have, but for the seed, which a listed scene's motion may have.
void refuse_for_listed(const std::string& file, const SceneOverrides& overrides);

}  // namespace touchstone::scene
