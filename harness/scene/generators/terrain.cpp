// Generator `terrain`: a height field with bodies that drive over it.
#include <algorithm>
#include <cmath>

#include "algorithms/core/nearest_float.h"
#include "harness/base/reproducible_math.h"
#include "harness/geometry/shapes/mesh_shapes.h"
#include "harness/scene/concave_shape.h"
#include "harness/scene/generators/generators.h"
#include "harness/scene/generators/world_size.h"

namespace touchstone::scene {
namespace {

Mat3d about_z(double turns) {
  const base::SinCos turn = base::sin_cos_turns(turns);
  Mat3d rotation;
  rotation << turn.cos, -turn.sin, 0, turn.sin, turn.cos, 0, 0, 0, 1;
  return rotation;
}

// The hills over [-side/2, side/2], as rows of vertices from low y to high.
class Ground {
 public:
  Ground(std::size_t cells, double side, double height, std::uint64_t seed)
      : cells_(cells), side_(side), mesh_(geometry::terrain(cells, 2 * height / side, seed)) {
    for (Vec3d& v : mesh_.vertices) v = nearest_float(Vec3d(0.5 * side * v));
  }

  // The greatest height of the vertices around a place.
  double height(double x, double y) const {
    const auto cell = [&](double at) {
      const double part = std::clamp(at / side_ + 0.5, 0.0, 1.0);
      return std::min(static_cast<std::size_t>(part * static_cast<double>(cells_)), cells_ - 1);
    };
    const std::size_t at = cell(y) * (cells_ + 1) + cell(x);
    double height = mesh_.vertices[at].z();
    for (const std::size_t corner : {at + 1, at + cells_ + 1, at + cells_ + 2}) {
      height = std::max(height, mesh_.vertices[corner].z());
    }
    return height;
  }

  geometry::Mesh mesh() const { return mesh_; }

 private:
  std::size_t cells_;
  double side_;
  geometry::Mesh mesh_;
};

}  // namespace

// Body 0 is the surface of the hills. The others stand upright on it, each turned about z, with
// their lowest points up to `layer` above or below the hills, and drive along the plane.
Generated make_terrain(GeneratorInput& input) {
  const double layer = input.table.number("layer", files::not_negative, 0.2);
  const auto cells = static_cast<std::size_t>(input.table.integer("cells", 1, 4096, 64));
  const double hills = input.table.number("hills", files::not_negative, 2.0);
  Generated made{make_bodies(input, {}, false, input.count - 1), 0};
  const RegionOf region = [](std::size_t, double side) {
    return Region{{-side / 2, -side / 2, 0}, {side, side, 0}};
  };
  made.side = read_world_side(input.table, made.scene, region, {.overlaps = 0.5}, false,
                              input.random(GeneratorInput::world_stream));
  const Ground ground(cells, made.side, hills, input.random(GeneratorInput::world_stream).next());
  const std::vector<Aabb> boxes = boxes_at_origin(made.scene);
  base::Random places = input.random(GeneratorInput::place_stream);
  for (std::size_t i = 0; i < made.scene.bodies.size(); ++i) {
    Pose& pose = made.scene.bodies[i].pose;
    const double x = made.side * (places.unit() - 0.5), y = made.side * (places.unit() - 0.5);
    pose.rotation = base::product(about_z(places.unit()), pose.rotation);
    const double low = static_cast<double>(boxes[i].min[2]);
    pose.translation = {x, y, ground.height(x, y) - low + layer * (2 * places.unit() - 1)};
  }
  set_in_motion(input, {.speed = 5, .spin = 0}, 0, made.scene);
  for (Body& body : made.scene.bodies) body.velocity.z() = 0;
  const double top = 2 * hills + 10 * made.side;
  set_walls(input, {-made.side / 2, -made.side / 2, -top}, {made.side / 2, made.side / 2, top},
            made.scene);

  const ConcaveShape shape = mesh_shape(ground.mesh(), MeshUse::surface);
  Body hill;
  hill.shape = made.scene.add_shape(shape.hull, shape.mesh, shape.body);
  hill.moving = false;
  made.scene.bodies.insert(made.scene.bodies.begin(), hill);
  return made;
}

}  // namespace touchstone::scene
