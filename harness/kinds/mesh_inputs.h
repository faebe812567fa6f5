// The meshes that cells of rays and of points are asked about.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "algorithms/core/mesh/triangle_mesh.h"
#include "harness/base/random.h"
#include "harness/files/toml_table.h"

namespace touchstone::kinds {

struct MeshInput {
  std::string title;  // name and count of triangles
  TriangleMesh mesh;
  Vec3d low = Vec3d::Zero(), high = Vec3d::Zero();  // the box of its vertices

  Vec3d centre() const { return 0.5 * (low + high); }
  // A point of the box.
  Vec3d draw(base::Random& random) const;
};

// The mesh of this name, which the key has. Throws InputError if it cannot be read, or has no triangles.
TriangleMesh mesh_of(const std::string& name, const std::filesystem::path& home,
                     files::TomlTable& table, const char* key);

// Those that the key `meshes` names, or `without` the key; files are relative to `home`. Throws InputError
// as above.
std::vector<std::shared_ptr<const MeshInput>> mesh_inputs(files::TomlTable& table,
                                                          const std::filesystem::path& home,
                                                          const std::vector<std::string>& without);

}  // namespace touchstone::kinds
