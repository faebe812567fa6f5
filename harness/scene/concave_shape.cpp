// Makes the hulls of bodies that are not convex, bounds such bodies, and reads the sizes of made
// meshes and height fields.
#include "harness/scene/concave_shape.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "algorithms/core/bounds.h"
#include "algorithms/core/mesh/common_frame.h"
#include "algorithms/core/mesh/placed_box.h"
#include "algorithms/hull/convex_hull.h"
#include "harness/files/height_grid.h"
#include "harness/geometry/concave_bodies.h"
#include "harness/geometry/mesh_shapes.h"

namespace touchstone::scene {
namespace {

Shape reduced_hull(const std::vector<Vec3d>& points) {
  Shape shape;
  shape.kind = ShapeKind::hull;
  shape.hull = make_reduced_hull(points);
  return shape;
}

// A bound on how much longer the matrix makes a vector.
double stretch_of(const Mat3d& rotation) {
  const Mat3d product = (rotation.transpose() * rotation).cwiseAbs();
  return std::sqrt(product.rowwise().sum().maxCoeff()) * (1 + 0x1p-48);
}

}  // namespace

ConcaveShape mesh_shape(geometry::Mesh mesh, MeshUse use) {
  if (use == MeshUse::compound) return compound_shape(geometry::mesh_body(mesh, use));
  ConcaveShape made{reduced_hull(mesh.vertices), nullptr, nullptr};
  if (use != MeshUse::hull) {
    made.body = std::make_shared<const ConcaveBody>(geometry::mesh_body(mesh, use));
  }
  made.mesh = std::make_shared<const geometry::Mesh>(std::move(mesh));
  return made;
}

ConcaveShape compound_shape(ConcaveBody body) {
  geometry::Mesh mesh = geometry::surface_of(body);
  ConcaveShape made{reduced_hull(mesh.vertices), nullptr, nullptr};
  made.mesh = std::make_shared<const geometry::Mesh>(std::move(mesh));
  made.body = std::make_shared<const ConcaveBody>(std::move(body));
  return made;
}

Aabb concave_box(const ConcaveBody& body, const Shape& hull, const Pose& pose) {
  if (body.mesh != nullptr) return tight_box(hull, pose);
  Aabb around = Aabb::empty();
  const double stretch = stretch_of(pose.rotation);
  for (const ConvexPart& part : body.parts) {
    const double reach = reach_of({{tight_box(part.shape, Pose{})}});
    const ComposedPose placed = composed(pose, part.pose, reach);
    const Aabb box = tight_box(part.shape, placed.pose);
    const double slack = placed.error + 2 * stretch * part.rounding;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      around.min[axis] = std::min(around.min[axis], round_down(double{box.min[axis]} - slack));
      around.max[axis] = std::max(around.max[axis], round_up(double{box.max[axis]} + slack));
    }
  }
  return around;
}

double concave_reach(const ConcaveBody& body, const Shape& hull, const Mat3d& rotation) {
  if (body.mesh != nullptr) return loose_reach(hull, rotation);
  double reach = 0;
  for (const ConvexPart& part : body.parts) {
    reach = std::max(reach, part.pose.translation.stableNorm() + part.rounding +
                                loose_reach(part.shape, part.pose.rotation));
  }
  return reach * stretch_of(rotation) * (1 + 0x1p-40);
}

namespace {

files::HeightGrid inline_heights(files::TomlTable& table) {
  files::HeightGrid grid;
  for (const std::vector<double>& row : table.rows("heights")) {
    grid.columns = row.size();
    ++grid.rows;
    grid.heights.insert(grid.heights.end(), row.begin(), row.end());
  }
  if (grid.rows < 2 || grid.columns < 2 || grid.rows > files::most_heights_a_side ||
      grid.columns > files::most_heights_a_side) {
    table.fail("heights",
               fmt::format("{} x {} heights; expected at least 2 rows of 2, and at most {} a side",
                           grid.rows, grid.columns, files::most_heights_a_side));
  }
  return grid;
}

// The sizes of a cell along x and y.
std::pair<double, double> cell_size(files::TomlTable& table, std::optional<double> of_file) {
  const toml::node* node = table.node("cell_size");
  if (node != nullptr && node->is_array()) {
    const std::vector<double> sizes = table.numbers("cell_size", 2, files::positive);
    return {sizes[0], sizes[1]};
  }
  const double size = table.number("cell_size", files::positive, of_file);
  return {size, size};
}

geometry::Mesh height_field(files::TomlTable& table, const FindFile& file) {
  if (table.contains("file") && table.contains("heights")) {
    table.fail("file", "given beside heights; expected one of the two");
  }
  files::HeightGrid grid =
      table.contains("file")
          ? files::read_heights(file("file", "a PNG image, or an .asc, .csv or .txt grid"))
          : inline_heights(table);
  const double scale = table.number("height_scale", files::positive, 1.0);
  for (double& height : grid.heights) height *= scale;
  const auto [x, y] = cell_size(table, grid.cell_size);
  return geometry::height_field(grid.rows, grid.columns, grid.heights, x, y);
}

}  // namespace

geometry::Mesh made_mesh(files::TomlTable& table, std::string_view type, const FindFile& file) {
  const auto count = [&](std::string_view key, std::int64_t low, std::int64_t usual) {
    return static_cast<std::size_t>(table.integer(key, low, 4096, usual));
  };
  const auto length = [&](std::string_view key, double usual, double high = 0.99) {
    return table.number(key, {.low = 0.01, .high = high}, usual);
  };
  if (type == "torus") {
    return geometry::torus(count("around", 3, 32), count("across", 3, 16),
                           length("tube_radius", 0.25));
  }
  if (type == "trefoil") {
    return geometry::trefoil(count("around", 12, 96), count("across", 3, 12),
                             length("tube_radius", 0.25));
  }
  if (type == "terrain") {
    const std::size_t cells = count("cells", 1, 64);
    return geometry::terrain(cells, table.number("height", files::not_negative, 0.1),
                             static_cast<std::uint64_t>(table.integer("seed", 0, INT64_MAX, 1)));
  }
  if (type == "height_field") return height_field(table, file);
  const std::size_t teeth = count("teeth", 3, 16);
  const double root = length("root_radius", 0.8), hole = length("hole_radius", 0.3);
  if (hole >= root) {
    table.fail("hole_radius",
               fmt::format("found {}; expected less than root_radius {}", hole, root));
  }
  return geometry::gear(teeth, root, hole, length("thickness", 0.3, 100));
}

}  // namespace touchstone::scene
