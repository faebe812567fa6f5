// Triangle meshes from files.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "algorithms/core/vec.h"

namespace touchstone {

struct Mesh {
  std::vector<Vec3d> vertices;                          // in the file's units
  std::vector<std::array<std::uint32_t, 3>> triangles;  // polygons are cut into fans
};

// Reads OBJ, OFF, STL (text or binary) or PLY (text or binary, either byte order), told by the
// file's ending. Throws InputError with file and line (or byte offset, for binary) and what was
// expected; an index out of range, a number that is none, NaN, infinity, a file that ends early and
// a mesh without vertices are errors. Normals, colours, texture and material are passed over.
Mesh read_mesh(const std::filesystem::path& file);

}  // namespace touchstone
