// Reads meshes by name, and draws points in their boxes.
#include "harness/kinds/mesh_inputs.h"

#include <fmt/format.h>

#include <utility>

#include "harness/base/error.h"
#include "harness/geometry/mesh_shapes.h"

namespace touchstone::kinds {

Vec3d MeshInput::draw(base::Random& random) const {
  Vec3d point;
  for (int k = 0; k < 3; ++k) point[k] = random.uniform(low[k], high[k]);
  return point;
}

TriangleMesh mesh_of(const std::string& name, const std::filesystem::path& home,
                     files::TomlTable& table, const char* key) {
  TriangleMesh mesh;
  try {
    geometry::Mesh read = geometry::named_mesh(name, home);
    mesh.vertices = std::move(read.vertices);
    mesh.triangles = std::move(read.triangles);
  } catch (const base::InputError& error) {
    table.fail(key, error.what());
  }
  if (mesh.triangles.empty()) table.fail(key, name + " has no triangles; expected some");
  return mesh;
}

std::vector<std::shared_ptr<const MeshInput>> mesh_inputs(files::TomlTable& table,
                                                          const std::filesystem::path& home,
                                                          const std::vector<std::string>& without) {
  std::vector<std::shared_ptr<const MeshInput>> inputs;
  for (const std::string& name : table.texts("meshes", without)) {
    const auto input = std::make_shared<MeshInput>();
    input->mesh = mesh_of(name, home, table, "meshes");
    const TriangleMesh& mesh = input->mesh;
    input->title = fmt::format("{}, {} triangles", name, mesh.triangles.size());
    input->low = input->high = mesh.vertices.front();
    for (const Vec3d& v : mesh.vertices) {
      input->low = input->low.cwiseMin(v);
      input->high = input->high.cwiseMax(v);
    }
    inputs.push_back(input);
  }
  return inputs;
}

}  // namespace touchstone::kinds
