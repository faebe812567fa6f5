// Seeded generators of scenes: the same bits on every platform.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "harness/files/toml_table.h"
#include "harness/scene/generators/shape_mix.h"
#include "harness/scene/scene.h"
#include "harness/scene/shape_reader.h"

namespace touchstone {

struct GeneratorInput {
  TomlTable& table;
  ShapeReader& shapes;
  std::int64_t count;  // bodies, at least one
  std::uint64_t seed;
  std::optional<double> gap = {};  // of all pairs, instead of the file's gaps (metres)
  int frames = 1;                  // of the scene, where the generator has to know

  // Independent random numbers for each thing that is drawn, so that a change of one parameter
  // leaves the others' draws as they were.
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
  Random random(Stream stream) const { return Random(seed, stream); }
};

// A scene with its walls, its kind of motion and its bodies' velocities. `side` is the world's
// (metres), to which accelerations are in proportion.
struct Generated {
  Scene scene;
  double side = 0;
};

struct Generator {
  std::string_view name;
  Generated (*make)(GeneratorInput&);
};

std::span<const Generator> generators();

// The parts that generators share.

// Bodies of a mix of shapes, `turned` at random or not, without places.
Scene make_bodies(GeneratorInput& input, const ShapeMixDefaults& defaults, bool turned,
                  std::int64_t count);
struct MovementDefaults {
  double moving = 1;  // share of the bodies
  double speed = 1;   // metres a second, greatest
  double spin = 1;    // radians a second, greatest
};
// Reads `moving`, `speed` and `spin`, and gives the bodies from `first` on random velocities:
// exactly that share of them, to the nearest body, moves. Sets the speed of the motion too.
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
Generated make_pairs(GeneratorInput& input);

}  // namespace touchstone
