// Writes meshes.
#include "harness/check/kinds/blocks/mesh_targets.h"

#include <fmt/format.h>

#include "harness/files/text_file.h"

namespace touchstone::check {

void write_mesh(const std::filesystem::path& file, const TriangleMesh& mesh) {
  std::string text = fmt::format("OFF\n{} {} 0\n", mesh.vertices.size(), mesh.triangles.size());
  for (const Vec3d& v : mesh.vertices) text += fmt::format("{} {} {}\n", v.x(), v.y(), v.z());
  for (const auto& [a, b, c] : mesh.triangles) text += fmt::format("3 {} {} {}\n", a, b, c);
  files::write_text(file, text);
}

}  // namespace touchstone::check
