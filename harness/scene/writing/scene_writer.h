// Writes scenes.
#pragma once

#include <filesystem>
#include <span>

#include "algorithms/scene_ray_cast.h"

namespace touchstone::scene {

// Writes a scene file that load_scene turns into the same bodies, at rest, and an OFF file beside it for
// each mesh. Each body has a part, and half-spaces are bodies of their own. Where parts of a compound were
// placed within others, that their poses are rounded is lost.
void write_scene(const std::filesystem::path& file, std::span<const SceneBody> bodies);

// Writes the mesh so that it is read with the same bits, in the format OFF.
void write_off(const std::filesystem::path& file, const TriangleMesh& mesh);

}  // namespace touchstone::scene
