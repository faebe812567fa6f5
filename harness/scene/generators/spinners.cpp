// Generator `spinners`: long thin bars that turn fast in place among posts.
#include <cmath>

#include "harness/base/plain_math.h"
#include "harness/base/reproducible_math.h"
#include "harness/scene/generators/generators.h"

namespace touchstone::scene {
namespace {

constexpr std::int64_t group = 8;  // a spinner and its posts
constexpr double thinness = 100;   // length of a spinner over its width
constexpr double post_height = 1;  // of a spinner's length
constexpr double tilt = 0.2;       // greatest, of the axis from the vertical, as a tangent

}  // namespace

// A grid of cells with one spinner and seven posts each. The spinner, a box of `size` and a
// hundredth of that, turns by 0.75 to 1 times `spin` about an axis near the vertical. The posts are
// upright cylinders at random places of the cell, some out of reach.
Generated make_spinners(GeneratorInput& input) {
  const double size = input.table.number("size", files::positive, 2.0);
  const double spin = input.table.number("spin", files::not_negative, 60.0);
  const auto [thin, thick] = input.table.range("post", files::positive, {0.01 * size, 0.05 * size});

  Generated made;
  Scene& scene = made.scene;
  Shape bar;
  bar.kind = ShapeKind::box;
  bar.half_extents = {size / 2, size / thinness / 2, size / thinness / 2};
  scene.shapes = {bar};
  const std::int64_t cells = (input.count + group - 1) / group;
  std::int64_t row = 1;
  while (row * row < cells) ++row;
  const double width = 1.5 * size;
  made.side = static_cast<double>(row) * width;
  base::Random shapes = input.random(GeneratorInput::shape_stream);
  base::Random poses = input.random(GeneratorInput::pose_stream);
  base::Random places = input.random(GeneratorInput::place_stream);
  base::Random velocities = input.random(GeneratorInput::velocity_stream);
  for (std::int64_t i = 0; i < input.count; ++i) {
    const std::int64_t cell = i / group;
    const Vec3d centre = {(static_cast<double>(cell % row) + 0.5) * width,
                          (static_cast<double>(cell / row) + 0.5) * width, 0};
    Body body;
    body.pose.translation = centre;
    if (i % group == 0) {
      const Vec3d axis =
          base::unit({tilt * velocities.uniform(-1, 1), tilt * velocities.uniform(-1, 1), 1});
      const Vec3d along = base::beside(axis, poses.on_sphere()), third = base::outer(axis, along);
      body.pose.rotation << along.x(), third.x(), axis.x(), along.y(), third.y(), axis.y(),
          along.z(), third.z(), axis.z();
      const double way = velocities.below(2) == 0 ? 1 : -1;
      body.angular_velocity = way * spin * velocities.uniform(0.75, 1) * axis;
    } else {
      Shape post;
      post.kind = ShapeKind::cylinder;
      post.radius = shapes.uniform(thin, thick) / 2;
      post.half_length = post_height * size / 2;
      body.shape = static_cast<std::uint32_t>(scene.shapes.size());
      scene.shapes.push_back(post);
      body.moving = false;
      body.pose.translation +=
          Vec3d{places.uniform(-0.5, 0.5) * width, places.uniform(-0.5, 0.5) * width, 0};
    }
    scene.bodies.push_back(body);
  }
  return made;
}

}  // namespace touchstone::scene
