// Seeded generators of scenes. They give the same bits on every platform.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "harness/files/toml_table.h"
#include "harness/scene/generators/shape_mix.h"
#include "harness/scene/scene.h"
#include "harness/scene/shape_reader.h"

namespace touchstone::scene {

struct GeneratorInput {
  files::TomlTable& table;
  ShapeReader& shapes;
  std::int64_t count;  // number of bodies, at least one
  std::uint64_t seed;
  std::optional<double> gap = {};     // replaces the file's gaps for all pairs (metres)
  int frames = 1;                     // the scene's frames, for generators that need the number
  std::optional<double> moving = {};  // replaces the file's share of moving bodies
  bool takes_moving = false;          // the generator has asked for that share

  // Returns the share of the bodies that move.
  double share_moving(double fallback) {
    takes_moving = true;
    const double own = table.number("moving", {.low = 0, .high = 1}, fallback);
    return moving.value_or(own);
  }

  // Independent streams of random numbers for each property, so that a change of one parameter
  // leaves the other draws as they were.
  enum Stream : std::uint64_t {
    shape_stream,
    pose_stream,
    place_stream,
    velocity_stream,
    moving_stream,
    world_stream,
    motion_stream,
    order_stream,
    arrival_stream
  };
  base::Random random(Stream stream) const { return base::Random(seed, stream); }
};

// A scene with its walls, its kind of motion and its bodies' velocities. `side` is the world's
// (metres); accelerations are proportional to it.
struct Generated {
  Scene scene;
  double side = 0;
};

struct Generator {
  std::string_view name;
  Generated (*make)(GeneratorInput&);
  bool is_of_motion = false;  // bodies move far within a frame, for casts
};

std::span<const Generator> generators();

// True if the file is a scene of such a generator. Throws InputError if it is TOML that cannot be read.
bool is_scene_of_motion(const std::filesystem::path& file);

// Makes bodies from a mix of shapes, without positions. `turned` is the default for random
// orientations.
Scene make_bodies(GeneratorInput& input, const ShapeMixDefaults& defaults, bool turned,
                  std::int64_t count);
struct MovementDefaults {
  double moving = 1;  // share of the bodies
  double speed = 1;   // metres per second, greatest
  double spin = 1;    // radians per second, greatest
};
// Reads `moving`, `speed` and `spin`, and gives random velocities to the bodies from `first` on.
// That share of them moves exactly, rounded to whole bodies. Also sets the speed of the motion.
void set_in_motion(GeneratorInput& input, const MovementDefaults& defaults, std::size_t first,
                   Scene& scene);
// Reads `walls` and encloses the region unless it is false.
void set_walls(GeneratorInput& input, const Vec3d& low, const Vec3d& high, Scene& scene);

Generated make_uniform(GeneratorInput& input);
Generated make_clustered(GeneratorInput& input);
Generated make_mixed(GeneratorInput& input);
Generated make_brownian(GeneratorInput& input);
Generated make_free_fall(GeneratorInput& input);
Generated make_rotating_gravity(GeneratorInput& input);
Generated make_city(GeneratorInput& input);
Generated make_stack(GeneratorInput& input);
Generated make_ground(GeneratorInput& input);
Generated make_bullets(GeneratorInput& input);
Generated make_spinners(GeneratorInput& input);
Generated make_robot(GeneratorInput& input);
Generated make_cards(GeneratorInput& input);
Generated make_terrain(GeneratorInput& input);
Generated make_chain(GeneratorInput& input);
Generated make_pairs(GeneratorInput& input);

}  // namespace touchstone::scene
