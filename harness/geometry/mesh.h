// Triangle meshes, read from files.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "algorithms/core/vec.h"

namespace touchstone::geometry {

struct Mesh {
  std::vector<Vec3d> vertices;                          // in the file's units
  std::vector<std::array<std::uint32_t, 3>> triangles;  // polygons are split into fans
};

// Reads OBJ, OFF, STL (text or binary) or PLY (text or binary, either byte order), selected by the
// file's extension. Throws InputError with file and line (or byte offset, for binary) and the
// expected content. Errors are: an index out of range, a malformed number, NaN, infinity, a file
// that ends early, and a mesh without vertices. Normals, colours, texture and material are ignored.
// A model (models/model.h) is all its triangles as one mesh, in metres, in the root frame of its file.
Mesh read_mesh(const std::filesystem::path& file);
// True for an extension that read_mesh takes.
bool is_mesh_file(const std::filesystem::path& file);
// The same, and a mesh without triangles is an error too.
Mesh read_surface(const std::filesystem::path& file);

}  // namespace touchstone::geometry
