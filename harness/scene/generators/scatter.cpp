// Generators that scatter bodies in a cube: evenly, in clusters, in very different sizes, or as
// Broadmark does.
#include <algorithm>

#include "harness/scene/generators/generators.h"
#include "harness/scene/generators/world_size.h"

namespace touchstone::scene {
namespace {

// Broadmark starts its bodies in a ball of 0.9 times the world's width.
constexpr double ball_radius = 0.45;
// Half the width of the cube that has the ball's volume.
constexpr double ball_as_cube = ball_radius * 0.8059959770082348;

Region centred(double half_width) {
  return {Vec3d::Constant(-half_width), Vec3d::Constant(2 * half_width)};
}

Vec3d place_in(const Region& region, base::Random& random) {
  Vec3d place;
  for (int axis = 0; axis < 3; ++axis) {
    place[axis] = region.low[axis] + region.width[axis] * random.unit();
  }
  return place;
}

void enclose(GeneratorInput& input, double side, Scene& scene) {
  set_walls(input, Vec3d::Constant(-side / 2), Vec3d::Constant(side / 2), scene);
}

Generated scatter_evenly(GeneratorInput& input, const ShapeMixDefaults& sizes) {
  Generated made{make_bodies(input, sizes, true, input.count), 0};
  const RegionOf region = [](std::size_t, double side) { return centred(side / 2); };
  made.side = read_world_side(input.table, made.scene, region, {}, true,
                              input.random(GeneratorInput::world_stream));
  base::Random places = input.random(GeneratorInput::place_stream);
  for (Body& body : made.scene.bodies) {
    body.pose.translation = place_in(centred(made.side / 2), places);
  }
  set_in_motion(input, {}, 0, made.scene);
  enclose(input, made.side, made.scene);
  return made;
}

// Broadmark's initial state (Serpa and Rodrigues 2020, and their scene generator): unit cubes in a
// ball in the middle of a cube of volume N * scale^3 / density, with velocities in a ball of 0.75
// world widths per second. The bodies here rotate from the start, because no solver makes them
// rotate.
Generated scatter_as_broadmark(GeneratorInput& input, MotionKind motion) {
  Generated made{make_bodies(input, {.size = {1, 1}, .aspect = 1}, false, input.count), 0};
  made.scene.motion.kind = motion;
  const RegionOf region = [](std::size_t, double side) { return centred(ball_as_cube * side); };
  made.side = read_world_side(input.table, made.scene, region, {.density = 0.1}, true,
                              input.random(GeneratorInput::world_stream));
  base::Random places = input.random(GeneratorInput::place_stream);
  for (Body& body : made.scene.bodies) {
    body.pose.translation = ball_radius * made.side * places.in_ball();
  }
  set_in_motion(input, {.speed = 0.75 * made.side}, 0, made.scene);
  enclose(input, made.side, made.scene);
  return made;
}

}  // namespace

Generated make_uniform(GeneratorInput& input) { return scatter_evenly(input, {}); }

Generated make_mixed(GeneratorInput& input) {
  return scatter_evenly(input, {.size = {0.01, 10}, .law = SizeLaw::over_magnitudes});
}

// Clusters are cubes of `spread` times the world's half width, anywhere in it. Each body is in one
// of them.
Generated make_clustered(GeneratorInput& input) {
  Generated made{make_bodies(input, {}, true, input.count), 0};
  const std::int64_t clusters =
      input.table.integer("clusters", 1, 1'000'000, std::max<std::int64_t>(1, input.count / 100));
  const double spread = input.table.number("spread", {.low = 1e-6, .high = 1}, 0.1);
  base::Random places = input.random(GeneratorInput::place_stream);
  std::vector<Vec3d> centres;  // for a world of side 2
  for (std::int64_t i = 0; i < clusters; ++i) {
    centres.push_back(place_in(centred(1 - spread), places));
  }
  std::vector<std::size_t> cluster_of;
  for (std::int64_t i = 0; i < input.count; ++i) cluster_of.push_back(places.below(centres.size()));
  const RegionOf region = [&](std::size_t body, double side) {
    Region within = centred(spread * side / 2);
    within.low += centres[cluster_of[body]] * (side / 2);
    return within;
  };
  made.side = read_world_side(input.table, made.scene, region, {.overlaps = 5}, true,
                              input.random(GeneratorInput::world_stream));
  for (std::size_t i = 0; i < made.scene.bodies.size(); ++i) {
    made.scene.bodies[i].pose.translation = place_in(region(i, made.side), places);
  }
  set_in_motion(input, {}, 0, made.scene);
  enclose(input, made.side, made.scene);
  return made;
}

Generated make_brownian(GeneratorInput& input) {
  return scatter_as_broadmark(input, MotionKind::brownian);
}

Generated make_free_fall(GeneratorInput& input) {
  return scatter_as_broadmark(input, MotionKind::free_fall);
}

Generated make_rotating_gravity(GeneratorInput& input) {
  return scatter_as_broadmark(input, MotionKind::rotating_gravity);
}

}  // namespace touchstone::scene
