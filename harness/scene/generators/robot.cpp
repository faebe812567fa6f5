// Generator `robot`: an arm that goes from one configuration to another in one frame, among obstacles.
#include <cmath>
#include <vector>

#include "harness/base/plain_math.h"
#include "harness/base/reproducible_math.h"
#include "harness/scene/generators/generators.h"

namespace touchstone::scene {
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
      body.pose.translation = base_place + arm *
                                               places.uniform(nearest_obstacle, farthest_obstacle) *
                                               places.on_sphere();
      scene.bodies.push_back(body);
    }
  }
  scene.bodies.resize(static_cast<std::size_t>(input.count));
  return made;
}

}  // namespace touchstone::scene
