// Generators of bodies that move far in one frame.
#include <algorithm>
#include <cmath>
#include <vector>

#include "harness/base/reproducible_math.h"
#include "harness/scene/generators/generators.h"

namespace touchstone::scene {

// Generator `bullets`: small bodies that fly through thin plates.

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

// Generator `spinners`: long thin bars that turn fast in place among posts.

namespace {

constexpr std::int64_t group = 8;     // a spinner and its posts
constexpr double thinness = 100;      // length of a spinner over its width
constexpr double post_height = 1;     // of a spinner's length
constexpr double spinner_tilt = 0.2;  // greatest, of the axis from the vertical, as a tangent

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
      const Vec3d axis = base::unit(
          {spinner_tilt * velocities.uniform(-1, 1), spinner_tilt * velocities.uniform(-1, 1), 1});
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

// Generator `robot`: an arm that goes from one configuration to another in one frame, among obstacles.

namespace {

constexpr double link_width = 0.12;  // of its length
// How far obstacles are from the arm's base, in lengths of the arm.
constexpr double nearest_obstacle = 0.25, farthest_obstacle = 1.1;

// The angles of all links from the x axis, in turns, from those at the joints.
std::vector<double> link_angles(const std::vector<double>& joints) {
  std::vector<double> angles;
  double sum = 0;
  for (const double joint : joints) angles.push_back(sum += joint);
  return angles;
}

// The centres of the links in the arm's plane, whose base is the origin.
std::vector<Vec3d> link_centres(const std::vector<double>& angles, double link) {
  std::vector<Vec3d> centres;
  Vec3d joint = Vec3d::Zero();
  for (const double angle : angles) {
    const base::SinCos turn = base::sin_cos_turns(angle);
    const Vec3d along = {link * turn.cos, link * turn.sin, 0};
    centres.push_back(joint + 0.5 * along);
    joint += along;
  }
  return centres;
}

}  // namespace

// Arms of `links` links of length `size`, each with `obstacles` balls, boxes and capsules at rest
// about it; `count` is the bodies in all, and the last arm may have fewer. The joints of an arm turn
// about parallel axes, by up to `sweep` radians a frame each. A link turns by the sum of its joints'
// angles while its centre goes straight from its first place to its last one, so both configurations
// are exact and neighbouring links part a little between them.
Generated make_robot(GeneratorInput& input) {
  const std::int64_t links = input.table.integer("links", 1, 1000, 6);
  const std::int64_t obstacles = input.table.integer("obstacles", 0, 1'000'000, 58);
  const double size = input.table.number("size", files::positive, 0.4);
  const double sweep = input.table.number("sweep", files::not_negative, 0.6);
  const double time_step =
      input.table.number("time_step", {.low = 1e-9, .high = 1e6}, Motion{}.time_step);

  Generated made;
  Scene& scene = made.scene;
  Shape link, ball, capsule, crate;
  link.kind = capsule.kind = ShapeKind::capsule;
  link.radius = link_width * size / 2;
  link.half_length = size / 2 - link.radius;
  ball.radius = 0.2 * size;
  capsule.radius = 0.1 * size;
  capsule.half_length = 0.4 * size;
  crate.kind = ShapeKind::box;
  crate.half_extents = {0.2 * size, 0.15 * size, 0.3 * size};
  scene.shapes = {link, ball, capsule, crate};
  const double arm = size * static_cast<double>(links);
  const std::int64_t arms = (input.count + links + obstacles - 1) / (links + obstacles);
  std::int64_t row = 1;
  while (row * row < arms) ++row;
  made.side = 2.5 * arm * static_cast<double>(row);

  base::Random poses = input.random(GeneratorInput::pose_stream);
  base::Random places = input.random(GeneratorInput::place_stream);
  base::Random velocities = input.random(GeneratorInput::velocity_stream);
  constexpr double turn = 6.283185307179586476925;
  for (std::int64_t a = 0; a < arms; ++a) {
    const Vec3d base_place = {2.5 * arm * static_cast<double>(a % row),
                              2.5 * arm * static_cast<double>(a / row), 0};
    const Mat3d plane = poses.rotation();
    std::vector<double> before, after;
    for (std::int64_t i = 0; i < links; ++i) {
      before.push_back((i == 0 ? 1.0 : 0.15) * poses.uniform(-0.5, 0.5));
      after.push_back(before.back() + sweep / turn * velocities.uniform(-1, 1));
    }
    before = link_angles(before);
    after = link_angles(after);
    const std::vector<Vec3d> from = link_centres(before, size), to = link_centres(after, size);
    for (std::size_t i = 0; i < from.size(); ++i) {
      Body body;
      // The link's z axis lies along it, its x axis along the joints' axes.
      const base::SinCos at = base::sin_cos_turns(before[i]);
      Mat3d in_plane;
      in_plane << 0, -at.sin, at.cos, 0, at.cos, at.sin, -1, 0, 0;
      body.pose.rotation = base::product(plane, in_plane);
      body.pose.translation = base_place + base::times(plane, from[i]);
      body.velocity = base::times(plane, to[i] - from[i]) / time_step;
      const double angle = turn * (after[i] - before[i]);
      body.angular_velocity = base::times(plane, Vec3d{0, 0, angle / time_step});
      scene.bodies.push_back(body);
    }
    for (std::int64_t i = 0; i < obstacles; ++i) {
      Body body;
      body.shape = 1 + static_cast<std::uint32_t>(i % 3);
      body.moving = false;
      body.pose.rotation = places.rotation();
      const Vec3d direction = places.on_sphere();
      const double distance = places.uniform(nearest_obstacle, farthest_obstacle);
      body.pose.translation = base_place + arm * distance * direction;
      scene.bodies.push_back(body);
    }
  }
  scene.bodies.resize(static_cast<std::size_t>(input.count));
  return made;
}

}  // namespace touchstone::scene
