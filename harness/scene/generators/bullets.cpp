// Generator `bullets`: small bodies that fly through thin plates.
#include <algorithm>
#include <cmath>

#include "harness/base/plain_math.h"
#include "harness/base/reproducible_math.h"
#include "harness/scene/generators/generators.h"

namespace touchstone::scene {
namespace {

constexpr double least_speed = 1.0 / 3;  // of the greatest
// The width of the world for each cube root of a body (metres): at 10 to 30 m a frame about a third
// of the bullets meet a plate.
constexpr double side_a_body = 2;

// A rotation that takes the z axis to a unit vector, evenly distributed about it.
Mat3d turned_along(const Vec3d& direction, base::Random& random) {
  const Vec3d x = base::beside(direction, random.on_sphere()), y = base::outer(direction, x);
  Mat3d rotation;
  rotation << x.x(), y.x(), direction.x(), x.y(), y.y(), direction.y(), x.z(), y.z(), direction.z();
  return rotation;
}

}  // namespace

// The share `plates` of the bodies are square plates of `size` and `thickness`, at rest. The others
// are bullets of `calibre`: balls, and capsules and boxes three times as long that point ahead, at a
// third of `speed` to all of it, with a spin about their axes.
Generated make_bullets(GeneratorInput& input) {
  const double share = input.table.number("plates", {.low = 0, .high = 1}, 0.25);
  const double size = input.table.number("size", files::positive, 1.0);
  const double thickness = input.table.number("thickness", files::positive, 0.002);
  const double calibre = input.table.number("calibre", files::positive, 0.009);
  const double speed = input.table.number("speed", files::not_negative, 900.0);
  const double spin = input.table.number("spin", files::not_negative, 0.0);

  Generated made;
  Scene& scene = made.scene;
  Shape plate, ball, capsule, bolt;
  plate.kind = bolt.kind = ShapeKind::box;
  plate.half_extents = {size / 2, size / 2, thickness / 2};
  ball.radius = capsule.radius = calibre / 2;
  capsule.kind = ShapeKind::capsule;
  capsule.half_length = calibre;
  bolt.half_extents = {calibre / 2, calibre / 2, 1.5 * calibre};
  scene.shapes = {plate, ball, capsule, bolt};
  made.side = side_a_body * size * base::cube_root(static_cast<double>(input.count));
  scene.motion.speed = speed;

  const auto plates =
      static_cast<std::int64_t>(std::floor(share * static_cast<double>(input.count) + 0.5));
  base::Random places = input.random(GeneratorInput::place_stream);
  base::Random poses = input.random(GeneratorInput::pose_stream);
  base::Random velocities = input.random(GeneratorInput::velocity_stream);
  for (std::int64_t i = 0; i < input.count; ++i) {
    Body body;
    for (int axis = 0; axis < 3; ++axis)
      body.pose.translation[axis] = made.side * (places.unit() - 0.5);
    if (i < plates) {
      body.pose.rotation = poses.rotation();
      body.moving = false;
    } else {
      const Vec3d direction = velocities.on_sphere();
      body.shape = 1 + static_cast<std::uint32_t>((i - plates) % 3);
      body.pose.rotation = turned_along(direction, poses);
      body.velocity = speed * velocities.uniform(least_speed, 1) * direction;
      body.angular_velocity = spin * velocities.uniform(-1, 1) * direction;
    }
    scene.bodies.push_back(body);
  }
  return made;
}

}  // namespace touchstone::scene
