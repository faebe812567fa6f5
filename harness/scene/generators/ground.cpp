// Generators of scenes on the ground.
#include <algorithm>
#include <cmath>

#include "algorithms/core/nearest_float.h"
#include "harness/base/reproducible_math.h"
#include "harness/geometry/mesh_shapes.h"
#include "harness/scene/concave_shape.h"
#include "harness/scene/generators/generators.h"
#include "harness/scene/generators/world_size.h"

namespace touchstone::scene {

// Generator `ground`: one large ground body with many small bodies on it.

// Body 0 is a box whose upper side is z = 0. The others' origins are spread evenly over it, up to
// `layer` above it, so that the lower ones penetrate the ground.
Generated make_ground(GeneratorInput& input) {
  const ShapeMixDefaults sizes{.size = {0.2, 1}};
  const double thickness = input.table.number("thickness", files::positive, 1.0);
  const double layer = input.table.number("layer", files::positive, 1.0);
  Generated made{make_bodies(input, sizes, true, input.count - 1), 0};
  const RegionOf region = [layer](std::size_t, double side) {
    return Region{{-side / 2, -side / 2, 0}, {side, side, layer}};
  };
  made.side = read_world_side(input.table, made.scene, region, {}, false,
                              input.random(GeneratorInput::world_stream));
  const Region world = region(0, made.side);
  base::Random places = input.random(GeneratorInput::place_stream);
  for (Body& body : made.scene.bodies) {
    for (int axis = 0; axis < 3; ++axis) {
      body.pose.translation[axis] = world.low[axis] + world.width[axis] * places.unit();
    }
  }
  set_in_motion(input, {}, 0, made.scene);
  set_walls(input, world.low, world.low + world.width, made.scene);

  Shape slab;
  slab.kind = ShapeKind::box;
  slab.half_extents = {made.side / 2, made.side / 2, thickness / 2};
  Body ground;
  ground.shape = made.scene.add_shape(slab);
  ground.pose.translation.z() = -thickness / 2;
  ground.moving = false;
  made.scene.bodies.insert(made.scene.bodies.begin(), ground);
  return made;
}

// Generator `terrain`: a height field with bodies that drive over it.

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

// Generator `city`: everything stands on one plane, so that all boxes overlap along z.

namespace {

constexpr double car_length = 4.5, car_width = 1.8, car_height = 1.5;  // metres

Shape box(double x, double y, double z) {
  Shape shape;
  shape.kind = ShapeKind::box;
  shape.half_extents = {x / 2, y / 2, z / 2};
  return shape;
}

}  // namespace

// Body 0 is the half-space z <= 0. The share `moving` of the others are cars, which drive along the
// streets at up to `speed`. The rest are buildings, one in each `block`, with various footprints
// and heights spread evenly over the magnitudes of `height`. All touch the ground.
Generated make_city(GeneratorInput& input) {
  const double block = input.table.number("block", {.low = 8, .high = 1e6}, 20.0);
  const auto [lowest, highest] = input.table.range("height", files::positive, {4, 200});
  const double share = input.share_moving(0.5);
  const double speed = input.table.number("speed", files::not_negative, 15.0);

  Generated made;
  Scene& scene = made.scene;
  Shape plane;
  plane.kind = ShapeKind::halfspace;
  scene.shapes = {plane, box(car_length, car_width, car_height),
                  box(car_width, car_length, car_height)};
  scene.bodies.resize(1);
  scene.bodies[0].moving = false;

  const std::int64_t cars =
      static_cast<std::int64_t>(std::floor(share * static_cast<double>(input.count - 1) + 0.5));
  const std::int64_t buildings = input.count - 1 - cars;
  std::int64_t blocks = 1;  // along each side
  while (blocks * blocks < std::max(buildings, cars / 4)) ++blocks;
  made.side = static_cast<double>(blocks) * block;
  const double start = -made.side / 2;

  base::Random shapes = input.random(GeneratorInput::shape_stream);
  for (std::int64_t i = 0; i < buildings; ++i) {
    const double width = block * shapes.uniform(0.4, 0.75);
    const double depth = block * shapes.uniform(0.4, 0.75);
    const double height = shapes.magnitude(lowest, highest);
    Body body;
    body.shape = static_cast<std::uint32_t>(scene.shapes.size());
    body.pose.translation = {start + (static_cast<double>(i % blocks) + 0.5) * block,
                             start + (static_cast<double>(i / blocks) + 0.5) * block, height / 2};
    body.moving = false;
    scene.shapes.push_back(box(width, depth, height));
    scene.bodies.push_back(body);
  }
  base::Random places = input.random(GeneratorInput::place_stream);
  for (std::int64_t i = 0; i < cars; ++i) {
    const std::uint64_t along = places.below(2);  // x or y
    const auto street = static_cast<double>(places.below(static_cast<std::uint64_t>(blocks) + 1));
    const double place = start + made.side * places.unit();
    Body body;
    body.shape = static_cast<std::uint32_t>(1 + along);
    body.pose.translation.z() = car_height / 2;
    body.pose.translation[static_cast<int>(along)] = place;
    body.pose.translation[static_cast<int>(1 - along)] = start + street * block;
    body.velocity[static_cast<int>(along)] = places.uniform(-speed, speed);
    scene.bodies.push_back(body);
  }
  scene.motion.speed = speed;
  set_walls(input, {start, start, 0}, {-start, -start, std::max(highest, car_height)}, scene);
  return made;
}

}  // namespace touchstone::scene
