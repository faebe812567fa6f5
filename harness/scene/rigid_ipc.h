// Scenes of the rigid-ipc project.
#pragma once

#include <filesystem>

#include "harness/scene/concave_shape.h"
#include "harness/scene/scene.h"

namespace touchstone::scene {

// Reads a rigid-ipc JSON scene (Ferguson et al., "Intersection-free Rigid Body Dynamics", SIGGRAPH
// 2021): bodies with mesh, position, rotation (degrees; about the model's origin, about x first,
// then y, then z), scale or dimensions, and velocities. Each mesh becomes what `use` says,
// once for each mesh and scale; without triangles, its hull. A body's origin is its mesh's centre of mass, about which it rotates. Meshes
// are searched relative to the scene file's folder and in a folder `meshes` beside or above it.
//
// Bodies keep their first velocities: gravity, forces, friction and contact are not simulated, and
// a fixed degree of freedom has no velocity. If no body moves there is one frame; otherwise the
// number follows from max_time or max_iterations, with at most 100 frames and none after the first
// kinematic_max_time. Throws InputError with the body's number and key, also for contents that
// would be shown wrong: two-dimensional scenes and scripted poses.
Scene import_rigid_ipc(const std::filesystem::path& file, MeshUse use = MeshUse::surface);

}  // namespace touchstone::scene
