// Scenes of the rigid-ipc project.
#pragma once

#include <filesystem>

#include "harness/scene/scene.h"

namespace touchstone {

// Reads a rigid-ipc JSON scene (Ferguson et al., "Intersection-free Rigid Body Dynamics", SIGGRAPH
// 2021): bodies with mesh, position, rotation (degrees), scale or dimensions, velocities. Each mesh
// is taken as its convex hull, each distinct mesh and scale once. Meshes are sought as the scene
// file says, relative to a folder `meshes` beside or above it. Throws InputError.
Scene import_rigid_ipc(const std::filesystem::path& file);

}  // namespace touchstone
