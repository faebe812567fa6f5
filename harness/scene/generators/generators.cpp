// The list of generators, and the parts that they share.
#include "harness/scene/generators/generators.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace touchstone::scene {

std::span<const Generator> generators() {
  static constexpr Generator all[] = {
      {"uniform", make_uniform},
      {"clustered", make_clustered},
      {"mixed", make_mixed},
      {"city", make_city},
      {"stack", make_stack},
      {"ground", make_ground},
      {"terrain", make_terrain},
      {"chain", make_chain},
      {"brownian", make_brownian},
      {"free_fall", make_free_fall},
      {"rotating_gravity", make_rotating_gravity},
      {"bullets", make_bullets, true},
      {"spinners", make_spinners, true},
      {"robot", make_robot, true},
      {"cards", make_cards, true},
      {"pairs", make_pairs},
  };
  return all;
}

bool is_scene_of_motion(const std::filesystem::path& file) {
  if (file.extension() != ".toml") return false;
  const toml::table table = files::parse_toml(file);
  const auto name = table["generator"].value<std::string>();
  return name && std::ranges::any_of(generators(), [&](const Generator& generator) {
           return generator.name == *name && generator.is_of_motion;
         });
}

Scene make_bodies(GeneratorInput& input, const ShapeMixDefaults& defaults, bool turned,
                  std::int64_t count) {
  Scene scene;
  base::Random shapes = input.random(GeneratorInput::shape_stream);
  const std::vector<TurnedShape> mix =
      make_shape_mix(input.table, input.shapes, count, defaults, shapes);
  // A body that is not convex is one shape, however often the mix has it: algorithms prepare each.
  std::map<const ConcaveBody*, std::uint32_t> known;
  std::vector<std::uint32_t> shape_of;
  for (const TurnedShape& entry : mix) {
    const auto next = static_cast<std::uint32_t>(scene.shapes.size());
    const bool is_new = entry.body == nullptr || known.emplace(entry.body.get(), next).second;
    shape_of.push_back(is_new ? scene.add_shape(entry.shape, entry.mesh, entry.body)
                              : known.at(entry.body.get()));
  }
  const bool turn = input.table.boolean("turned", turned);
  base::Random poses = input.random(GeneratorInput::pose_stream);
  scene.bodies.resize(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    Body& body = scene.bodies[i];
    body.shape = shape_of[i % mix.size()];
    const Mat3d& axis = mix[i % mix.size()].turn;
    body.pose.rotation = turn ? base::product(poses.rotation(), axis) : axis;
  }
  return scene;
}

void set_in_motion(GeneratorInput& input, const MovementDefaults& defaults, std::size_t first,
                   Scene& scene) {
  const double share = input.share_moving(defaults.moving);
  const double speed = input.table.number("speed", files::not_negative, defaults.speed);
  const double spin = input.table.number("spin", files::not_negative, defaults.spin);
  scene.motion.speed = speed;
  base::Random velocities = input.random(GeneratorInput::velocity_stream);
  base::Random choice = input.random(GeneratorInput::moving_stream);
  std::uint64_t left = scene.bodies.size() - first;
  auto wanted = static_cast<std::uint64_t>(std::floor(share * static_cast<double>(left) + 0.5));
  for (std::size_t i = first; i < scene.bodies.size(); ++i) {
    Body& body = scene.bodies[i];
    const Vec3d velocity = speed * velocities.in_ball();
    const Vec3d angular_velocity = spin * velocities.in_ball();
    body.moving = choice.below(left--) < wanted;
    if (!body.moving) continue;
    --wanted;
    body.velocity = velocity;
    body.angular_velocity = angular_velocity;
  }
}

void set_walls(GeneratorInput& input, const Vec3d& low, const Vec3d& high, Scene& scene) {
  if (!input.table.boolean("walls", true)) return;
  scene.motion.wall_min = low;
  scene.motion.wall_max = high;
}

}  // namespace touchstone::scene
