// A mesh by its name: a file, or one of mesh_shapes.h with a number of triangles.
#pragma once

#include <filesystem>
#include <string>

#include "harness/geometry/mesh.h"

namespace touchstone::geometry {

// "torus-2000", "trefoil-10000", "ellipsoid-5000" and "terrain-100000" are of about so many triangles
// (32 to 10 million); any other name is a file, relative to `home`. Throws InputError as read_surface does,
// and for another number.
Mesh named_mesh(const std::string& name, const std::filesystem::path& home);

}  // namespace touchstone::geometry
