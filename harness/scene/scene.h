// A scene: bodies with shapes and poses, and how they move from frame to frame.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "algorithms/core/aabb.h"
#include "algorithms/core/pair_sink.h"
#include "algorithms/core/pose.h"
#include "algorithms/core/shape.h"
#include "harness/geometry/mesh.h"

namespace touchstone {

// How a body's box is made (core/bounds.h).
enum class BoxKind : std::uint8_t { tight, loose };
std::string_view to_string(BoxKind kind);

struct Body {
  std::uint32_t shape = 0;                 // index into Scene::shapes
  Pose pose;                               // at frame 0
  Vec3d velocity = Vec3d::Zero();          // metres a second, world
  Vec3d angular_velocity = Vec3d::Zero();  // radians a second, world, about the body's origin
  bool moving = true;                      // false: stays at its pose whatever its velocities say
};

// How velocities change. All motion is kinematic: bodies pass through each other.
enum class MotionKind : std::uint8_t {
  inertial,          // velocities stay as they are
  brownian,          // each frame one body in a hundred is given a new random velocity
  free_fall,         // constant acceleration along -z
  rotating_gravity,  // constant acceleration whose direction turns in the x-z plane
};

struct Motion {
  MotionKind kind = MotionKind::inertial;
  double time_step = 1.0 / 30;  // seconds
  double acceleration = 0;      // metres a second squared: free_fall, rotating_gravity
  double period = 0;            // seconds a turn: rotating_gravity
  double speed = 0;             // metres a second, greatest: brownian's new velocities
  std::uint64_t seed = 0;       // brownian
  // Elastic walls: a body whose origin would leave comes back with that component of its velocity
  // turned. Without walls, min > max.
  Vec3d wall_min = Vec3d::Constant(1);
  Vec3d wall_max = Vec3d::Constant(-1);
  // Of the bodies that move, so many a frame exchange places at random, and so many go while as
  // many others come into their places; from frame 1 on.
  std::size_t teleports = 0;
  std::size_t churn = 0;
};

struct Scene {
  std::string name;  // the file's stem, unless it says otherwise
  std::vector<Shape> shapes;
  // Of shapes that are the convex hulls of meshes: those, in the same frame; null for the others.
  // Empty where no shape has one.
  std::vector<std::shared_ptr<const Mesh>> meshes;
  // The last Motion::churn of them are not there at frame 0.
  std::vector<Body> bodies;
  int frames = 1;  // at least one
  Motion motion;
  // A recording of boxes alone, one array a frame, as Broadmark's files hold; such a scene has no
  // bodies and no narrow phase. Empty otherwise.
  std::vector<std::vector<Aabb>> recording;
  // The pairs that narrow phases are asked about, sorted, a < b, where the scene lists them instead
  // of leaving it to a broad phase; the same in every frame. Empty otherwise.
  std::vector<IndexPair> pairs;

  std::uint32_t add_shape(Shape shape, std::shared_ptr<const Mesh> mesh = nullptr) {
    shapes.push_back(std::move(shape));
    if (mesh != nullptr || !meshes.empty()) {
      meshes.resize(shapes.size());
      meshes.back() = std::move(mesh);
    }
    return static_cast<std::uint32_t>(shapes.size() - 1);
  }
  const Mesh* mesh_of(std::size_t shape) const {
    return shape < meshes.size() ? meshes[shape].get() : nullptr;
  }

  // Bodies that are there at a time: the same in every frame.
  std::size_t size() const {
    return recording.empty() ? bodies.size() - motion.churn : recording.front().size();
  }
};

// What a user may change of a scene file from outside: a campaign's axes.
struct SceneOverrides {
  std::int64_t count = -1;  // bodies, of a generated scene; -1: as the file says
  std::int64_t seed = -1;   // of a generated scene; -1: as the file says
  int frames = -1;          // -1: as the file says
  // Metres, signed: of the pairs of the generator `pairs`; it becomes part of the scene's name.
  std::optional<double> gap = {};
};

// Reads a scene file: TOML (a generator, bodies, or an import), rigid-ipc's JSON, or Broadmark's
// .aabbs. Paths inside a scene file are relative to it. Throws InputError with file, line and what
// was expected; an override that the scene cannot take (a count for listed bodies) is one too.
Scene load_scene(const std::filesystem::path& file, const SceneOverrides& overrides = {});

// 16 hexadecimal digits over everything that decides what an algorithm is given: shapes, every
// frame's poses, or the recording. The same on every platform.
std::string scene_hash(const Scene& scene);

}  // namespace touchstone
