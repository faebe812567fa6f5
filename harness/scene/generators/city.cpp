// Generator `city`: everything stands on one plane, so that all boxes overlap along z.
#include <algorithm>
#include <cmath>

#include "harness/scene/generators/generators.h"

namespace touchstone::scene {
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
