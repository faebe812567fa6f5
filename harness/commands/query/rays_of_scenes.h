// `rays` at a scene.
#pragma once

#include <string>

#include "harness/commands/query/rays_files.h"

namespace touchstone::commands {

// True if the file's name is that of a scene, and not of a mesh.
bool is_scene(const std::string& file);

// Casts the rays at a frame of the scene, and writes a row for each answer.
void cast_rays_at_scene(const RaysOptions& options);

}  // namespace touchstone::commands
