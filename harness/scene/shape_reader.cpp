// Reads shapes and meshes of scene files, each mesh once.
#include "harness/scene/shape_reader.h"

#include "algorithms/hull/convex_hull.h"
#include "harness/geometry/mesh.h"
#include "harness/geometry/mesh_mass.h"

namespace touchstone::scene {
namespace {

// The rotation that takes the body's z axis to axis 0 (x), 1 (y) or 2 (z): a cyclic permutation.
Mat3d axis_turn(std::size_t axis) {
  Mat3d turn = Mat3d::Zero();
  for (std::size_t column = 0; column < 3; ++column) {
    turn(static_cast<int>((column + axis + 1) % 3), static_cast<int>(column)) = 1;
  }
  return turn;
}

geometry::Mesh read_scaled(const std::tuple<std::string, double, double, double>& mesh_and_scale) {
  const auto& [file, x, y, z] = mesh_and_scale;
  geometry::Mesh mesh = geometry::read_mesh(file);
  for (Vec3d& v : mesh.vertices) {
    v = v.cwiseProduct(Vec3d(x, y, z)).eval();
    if (!v.allFinite()) {
      throw base::InputError(file, 0, "not finite at the scene's scale; expected a smaller one");
    }
  }
  return mesh;
}

Shape hull_shape(std::shared_ptr<const Hull> hull) {
  Shape shape;
  shape.kind = ShapeKind::hull;
  shape.hull = std::move(hull);
  return shape;
}

}  // namespace

std::span<const std::string_view> shape_names() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> all;
    for (const ShapeKind kind : all_shape_kinds) all.push_back(to_string(kind));
    return all;
  }();
  return names;
}

std::filesystem::path ShapeReader::existing_file(files::TomlTable& table, std::string_view key,
                                                 std::string_view expected) const {
  const std::filesystem::path file = folder_ / table.text(key);
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) {
    table.fail(key, "no file " + file.string() + "; expected " + std::string(expected) +
                        (get_.empty() ? "" : ". To get it: " + get_));
  }
  return file;
}

ShapeReader::MeshAndScale ShapeReader::mesh_and_scale(files::TomlTable& table) const {
  const toml::node* scale_node = table.node("scale");
  const Vec3d scale = scale_node != nullptr && scale_node->is_array()
                          ? table.vector("scale", files::positive)
                          : Vec3d::Constant(table.number("scale", files::positive, 1.0));
  const std::filesystem::path file = existing_file(table, "mesh", "an OBJ, OFF, STL or PLY file");
  return {file.lexically_normal().string(), scale.x(), scale.y(), scale.z()};
}

TurnedShape ShapeReader::read_mesh_hull(files::TomlTable& table) {
  const MeshAndScale key = mesh_and_scale(table);
  TurnedShape& known = hulls_[key];
  if (known.mesh == nullptr) {
    known.mesh = std::make_shared<geometry::Mesh>(read_scaled(key));
    known.shape = hull_shape(make_reduced_hull(known.mesh->vertices));
  }
  return known;
}

const std::vector<MeshPart>& ShapeReader::read_parts(files::TomlTable& table) {
  const MeshAndScale key = mesh_and_scale(table);
  const auto [found, is_new] = parts_.try_emplace(key);
  if (!is_new) return found->second;
  for (geometry::Mesh& part : geometry::connected_parts(read_scaled(key))) {
    Vec3d low = part.vertices.front(), high = low;
    for (const Vec3d& v : part.vertices) {
      low = low.cwiseMin(v);
      high = high.cwiseMax(v);
    }
    const Vec3d centre = 0.5 * low + 0.5 * high;
    for (Vec3d& v : part.vertices) v -= centre;
    const Shape shape = hull_shape(make_reduced_hull(part.vertices));
    found->second.push_back({shape, std::make_shared<geometry::Mesh>(std::move(part)), centre});
  }
  if (found->second.empty()) {
    table.fail("parts", "the mesh has no triangles, so no parts; expected parts = false");
  }
  return found->second;
}

TurnedShape ShapeReader::read(files::TomlTable& table) {
  if (table.has("mesh")) return read_mesh_hull(table);
  TurnedShape turned;
  Shape& shape = turned.shape;
  shape.kind = all_shape_kinds[table.choice("type", shape_names())];
  switch (shape.kind) {
    case ShapeKind::sphere: shape.radius = table.number("radius", files::not_negative); break;
    case ShapeKind::capsule:
    case ShapeKind::cylinder:
    case ShapeKind::cone: {
      constexpr std::string_view axes[] = {"x", "y", "z"};
      shape.radius = table.number("radius", files::not_negative);
      shape.half_length = table.number("half_length", files::not_negative);
      turned.turn = axis_turn(table.choice("axis", axes, 2));
      break;
    }
    case ShapeKind::box:
      shape.half_extents = table.vector("half_extents", files::not_negative);
      break;
    case ShapeKind::ellipsoid: shape.radii = table.vector("radii", files::not_negative); break;
    case ShapeKind::hull: shape.hull = make_hull(table.points("vertices")); break;
    case ShapeKind::halfspace:
      shape.normal = table.vector("normal", files::any_number);
      shape.offset = table.number("offset", files::any_number);
      if (shape.normal == Vec3d::Zero()) {
        table.fail("normal", "found [0, 0, 0]; expected a vector that is not zero");
      }
      break;
  }
  return turned;
}

}  // namespace touchstone::scene
