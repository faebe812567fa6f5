// Scenes of the rigid-ipc project.
#pragma once

#include <filesystem>

#include "harness/scene/scene.h"

namespace touchstone {

// Reads a rigid-ipc JSON scene (Ferguson et al., "Intersection-free Rigid Body Dynamics", SIGGRAPH
// 2021): bodies with mesh, position, rotation (degrees; about the model's origin, about x first,
// then y, then z), scale or dimensions, velocities. Each mesh is taken as its convex hull, each
// distinct mesh and scale once. A body's origin is its mesh's centre of mass, so that it turns
// about that. Meshes are sought as the scene file says, relative to its folder and to a folder
// `meshes` beside or above it.
//
// Bodies keep their first velocities: gravity, forces, friction and contact are not simulated, and
// a degree of freedom that the file fixes has no velocity. Where no body moves there is one frame;
// otherwise as many as max_time or max_iterations says, at most 100, and none after the first
// kinematic_max_time. Throws InputError with the body's number and key, also for what would be
// shown wrong: two-dimensional scenes and scripted poses.
Scene import_rigid_ipc(const std::filesystem::path& file);

}  // namespace touchstone
