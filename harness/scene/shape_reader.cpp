#include "harness/scene/shape_reader.h"

#include "harness/scene/convex_hull.h"
#include "harness/scene/mesh.h"

namespace touchstone {
namespace {

// The turn that lays the body's z axis along axis 0 (x), 1 (y) or 2 (z): a cyclic permutation.
Mat3d axis_turn(std::size_t axis) {
  Mat3d turn = Mat3d::Zero();
  for (std::size_t column = 0; column < 3; ++column) {
    turn(static_cast<int>((column + axis + 1) % 3), static_cast<int>(column)) = 1;
  }
  return turn;
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

TurnedShape ShapeReader::read_mesh_hull(TomlTable& table) {
  const std::string name = table.text("mesh");
  const toml::node* scale_node = table.node("scale");
  const Vec3d scale = scale_node != nullptr && scale_node->is_array()
                          ? table.vector("scale", positive)
                          : Vec3d::Constant(table.number("scale", positive, 1.0));
  const std::filesystem::path file = folder_ / name;
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) {
    table.fail("mesh", "no file " + file.string() + "; expected an OBJ, OFF, STL or PLY file");
  }
  std::shared_ptr<const Hull>& hull =
      hulls_[{file.lexically_normal().string(), scale.x(), scale.y(), scale.z()}];
  if (hull == nullptr) {
    std::vector<Vec3d> points = read_mesh(file).vertices;
    for (Vec3d& point : points) point = point.cwiseProduct(scale).eval();
    hull = make_reduced_hull(points);
  }
  TurnedShape turned;
  turned.shape.kind = ShapeKind::hull;
  turned.shape.hull = hull;
  return turned;
}

TurnedShape ShapeReader::read(TomlTable& table) {
  if (table.has("mesh")) return read_mesh_hull(table);
  TurnedShape turned;
  Shape& shape = turned.shape;
  shape.kind = all_shape_kinds[table.choice("type", shape_names())];
  switch (shape.kind) {
    case ShapeKind::sphere: shape.radius = table.number("radius", not_negative); break;
    case ShapeKind::capsule:
    case ShapeKind::cylinder:
    case ShapeKind::cone: {
      constexpr std::string_view axes[] = {"x", "y", "z"};
      shape.radius = table.number("radius", not_negative);
      shape.half_length = table.number("half_length", not_negative);
      turned.turn = axis_turn(table.choice("axis", axes, 2));
      break;
    }
    case ShapeKind::box: shape.half_extents = table.vector("half_extents", not_negative); break;
    case ShapeKind::ellipsoid: shape.radii = table.vector("radii", not_negative); break;
    case ShapeKind::hull: shape.hull = make_hull(table.points("vertices")); break;
    case ShapeKind::halfspace:
      shape.normal = table.vector("normal", any_number);
      shape.offset = table.number("offset", any_number);
      if (shape.normal == Vec3d::Zero()) {
        table.fail("normal", "found [0, 0, 0]; expected a vector that is not zero");
      }
      break;
  }
  return turned;
}

}  // namespace touchstone
