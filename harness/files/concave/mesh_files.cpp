// Reads meshes beside files of cases.
#include "harness/files/concave/mesh_files.h"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include "harness/files/concave/concave_json.h"
#include "harness/geometry/mesh.h"
#include "harness/geometry/shapes/mesh_body.h"

namespace touchstone::files {
namespace {

using geometry::MeshUse;

Vec3d read_scale(const JsonNode& shape) {
  if (!shape.has("scale")) return Vec3d::Ones();
  const JsonNode node = shape.at("scale", "");
  const Vec3d scale = node.value().is_array() ? node.vector() : Vec3d::Constant(node.number());
  if (!(scale.array() > 0).all()) {
    node.fail(fmt::format("found {}; expected numbers > 0", node.found()));
  }
  return scale;
}

MeshUse read_use(const JsonNode& shape) {
  if (!shape.has("as")) return MeshUse::surface;
  constexpr std::string_view expected = "surface, solid, hull or compound";
  const JsonNode node = shape.at("as", expected);
  const auto at = std::ranges::find(geometry::mesh_use_names, node.text(expected));
  if (at == geometry::mesh_use_names.end()) {
    node.fail(fmt::format("found {}; expected {}", node.found(), expected));
  }
  return static_cast<MeshUse>(at - geometry::mesh_use_names.begin());
}

}  // namespace

bool is_mesh_file(const JsonNode& shape) {
  return shape.value().is_object() && shape.has("mesh") && !shape.has("type");
}

bool names_mesh(const JsonNode& body) {
  if (!body.value().is_object() || !body.has("mesh")) return false;
  if (body.has("shape")) body.fail("\"mesh\" is given beside \"shape\"; expected one of the two");
  return true;
}

const ConcaveBody& MeshFiles::body(const JsonNode& shape) {
  Json said;
  for (const char* key : {"mesh", "scale", "as"}) said[key] = shape.value().value(key, Json());
  const auto [known, is_new] = known_.try_emplace(said.dump(), all_.size());
  if (!is_new) return *all_[known->second].body;
  constexpr std::string_view expected = "an OBJ, OFF, STL or PLY file";
  const JsonNode node = shape.at("mesh", expected);
  const std::filesystem::path file =
      std::filesystem::path(node.file()).parent_path() / node.text(expected);
  std::error_code error;
  if (!std::filesystem::exists(file, error)) {
    node.fail(fmt::format("no file {}; expected {}", file.string(), expected));
  }
  const Vec3d scale = read_scale(shape);
  const MeshUse use = read_use(shape);
  geometry::Mesh mesh = geometry::read_mesh(file);
  for (Vec3d& v : mesh.vertices) {
    v = v.cwiseProduct(scale).eval();
    if (!v.allFinite()) shape.fail("not finite at this scale; expected a smaller one");
  }
  if (use != MeshUse::hull && mesh.triangles.empty()) {
    node.fail("the mesh has no triangles; expected some, or \"as\":\"hull\"");
  }
  auto body = std::make_shared<const ConcaveBody>(geometry::mesh_body(mesh, use));
  if (use == MeshUse::solid) check_closed(shape, *body->mesh, "\"as\" is \"solid\"");
  all_.push_back({file.string(), std::move(body)});
  return *all_.back().body;
}

}  // namespace touchstone::files
