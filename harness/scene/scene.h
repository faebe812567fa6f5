// A scene: bodies with shapes and poses, and their motion from frame to frame.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "algorithms/core/aabb.h"
#include "algorithms/core/mesh/concave_body.h"
#include "algorithms/core/pair_sink.h"
#include "algorithms/core/pose.h"
#include "algorithms/core/shape.h"
#include "algorithms/scene_ray_cast.h"
#include "harness/files/output_file.h"
#include "harness/geometry/mesh.h"

namespace touchstone::scene {

// The kind of a body's box (core/bounds.h).
enum class BoxKind : std::uint8_t { tight, loose };
std::string_view to_string(BoxKind kind);

struct Body {
  std::uint32_t shape = 0;                 // index into Scene::shapes
  Pose pose;                               // at frame 0
  Vec3d velocity = Vec3d::Zero();          // metres per second, world
  Vec3d angular_velocity = Vec3d::Zero();  // radians per second, world, about the body's origin
  bool moving = true;                      // false: stays at its pose whatever its velocities
};

// The change of velocities. All motion is kinematic: bodies pass through each other.
enum class MotionKind : std::uint8_t {
  inertial,          // velocities are constant
  brownian,          // each frame one body in a hundred gets a new random velocity
  free_fall,         // constant acceleration along -z
  rotating_gravity,  // constant acceleration whose direction rotates in the x-z plane
};

struct Motion {
  MotionKind kind = MotionKind::inertial;
  double time_step = 1.0 / 30;  // seconds
  double acceleration = 0;      // metres per second squared: free_fall, rotating_gravity
  double period = 0;            // seconds per turn: rotating_gravity
  double speed = 0;             // metres per second, greatest: new velocities of brownian
  std::uint64_t seed = 0;       // brownian
  // Elastic walls: a body whose origin would leave is reflected. There are no walls if min > max.
  Vec3d wall_min = Vec3d::Constant(1);
  Vec3d wall_max = Vec3d::Constant(-1);
  // Numbers of moving bodies per frame, from frame 1 on: `teleports` bodies exchange places at
  // random; `churn` bodies leave while as many others arrive in their places.
  std::size_t teleports = 0;
  std::size_t churn = 0;
};

// Which pairs of bodies narrow phases are asked: all, but for some. Broad phases find all pairs of boxes.
struct PairFilter {
  std::vector<IndexPair> ignored;  // sorted, a < b
  std::vector<char> rests;         // by body: no pair of two of these is asked; empty: none is

  bool is_empty() const { return ignored.empty() && rests.empty(); }
  bool asks(const IndexPair& pair) const;
  // Leaves the pairs that are asked.
  void apply(std::vector<IndexPair>& pairs) const;
};

// Poses of some bodies in each frame. In others than these frames they stay at the last ones.
struct Tracks {
  std::vector<std::uint32_t> bodies;  // ascending
  std::vector<Pose> poses;            // frame by frame, one a body each

  std::size_t frames() const { return bodies.empty() ? 0 : poses.size() / bodies.size(); }
};

struct Scene {
  std::string name;  // the file's stem, unless the file gives a name
  std::vector<Shape> shapes;
  // The meshes of shapes that are convex hulls of meshes, in the same frame; null for other shapes.
  // That of a compound is the surfaces of its parts, round ones as polytopes. Empty if no shape has
  // a mesh.
  std::vector<std::shared_ptr<const geometry::Mesh>> meshes;
  // The bodies of shapes that are not convex, in the same frame: such a shape is only the hull that
  // stands for the body. Null for convex ones. Empty if all are convex.
  std::vector<std::shared_ptr<const ConcaveBody>> concave;
  // The last Motion::churn bodies are not present at frame 0.
  std::vector<Body> bodies;
  int frames = 1;  // at least one
  Motion motion;
  // A recording of boxes alone, one array per frame, as in Broadmark's files. Such a scene has no
  // bodies and no narrow phase. Otherwise empty.
  std::vector<std::vector<Aabb>> recording;
  // The pairs for narrow phases, sorted, a < b, in a scene that lists them instead of using a broad
  // phase; equal in every frame. Otherwise empty.
  std::vector<IndexPair> pairs;
  PairFilter filter;
  Tracks tracks;  // of bodies that follow their poses in place of their velocities
  // The names of the bodies, if any has one: of a robot's, that of its link. Bodies may share a name.
  std::vector<std::string> names;
  // The files that it was read from: its own, one that it imports, meshes.
  std::vector<std::filesystem::path> files;

  std::uint32_t add_shape(Shape shape, std::shared_ptr<const geometry::Mesh> mesh = nullptr,
                          std::shared_ptr<const ConcaveBody> body = nullptr) {
    shapes.push_back(std::move(shape));
    if (mesh != nullptr || !meshes.empty()) {
      meshes.resize(shapes.size());
      meshes.back() = std::move(mesh);
    }
    if (body != nullptr || !concave.empty()) {
      concave.resize(shapes.size());
      concave.back() = std::move(body);
    }
    return static_cast<std::uint32_t>(shapes.size() - 1);
  }
  const geometry::Mesh* mesh_of(std::size_t shape) const {
    return shape < meshes.size() ? meshes[shape].get() : nullptr;
  }
  const ConcaveBody* concave_of(std::size_t shape) const {
    return shape < concave.size() ? concave[shape].get() : nullptr;
  }

  // Its files for files::check_outputs, which refuses to overwrite them.
  std::vector<files::NamedFile> inputs() const {
    std::vector<files::NamedFile> named;
    for (const std::filesystem::path& file : files) named.push_back({"a file of the scene", file});
    return named;
  }

  // The number of bodies present, which is equal in every frame.
  std::size_t size() const {
    return recording.empty() ? bodies.size() - motion.churn : recording.front().size();
  }
};

// Values of a scene file that a user may override: a campaign's axes.
struct SceneOverrides {
  std::int64_t count = -1;  // bodies of a generated scene; -1: from the file
  std::int64_t seed = -1;   // of a generated scene; -1: from the file
  int frames = -1;          // -1: from the file
  // Signed gap in metres for the generator `pairs`; it becomes part of the scene's name.
  std::optional<double> gap = {};
  // Share of the bodies of a generated scene that move, 0 to 1.
  std::optional<double> moving = {};
};

// Reads a scene file: TOML (a generator, bodies, or an import), rigid-ipc's JSON, Broadmark's
// .aabbs, a robot (.urdf) or a model (model_scene.h). Paths inside a scene file are relative to it. Throws InputError with file, line and the
// expected value, also for an override that does not apply to the scene (a count for listed
// bodies).
Scene load_scene(const std::filesystem::path& file, const SceneOverrides& overrides = {});

// The scene of a TOML file with this text, before it is written. Throws InputError as above, and toml::parse_error.
Scene scene_of_text(const std::string& text, const std::filesystem::path& file);

// Adds the bodies of a scene behind those of another, with their tracks and ignored pairs. Where one has fewer frames
// its bodies stay at their last poses. The motion is that of `to`.
void append(Scene from, Scene& to);

// Returns 16 hexadecimal digits that depend on all inputs of an algorithm: shapes, every frame's
// poses, or the recording. Equal on every platform.
std::string scene_hash(const Scene& scene);

// Writes a scene file that load_scene turns into the same bodies, at rest, and an OFF file beside it for
// each mesh. Each body has a part, and half-spaces are bodies of their own. Where parts of a compound were
// placed within others, that their poses are rounded is lost. `names`: none, or one for each body, without
// quotes. `keys` is TOML of the scene's other keys.
void write_scene(const std::filesystem::path& file, std::span<const SceneBody> bodies,
                 std::span<const std::string> names = {}, const std::string& keys = {});

// Writes the mesh so that it is read with the same bits, in the format OFF.
void write_off(const std::filesystem::path& file, const TriangleMesh& mesh);

}  // namespace touchstone::scene
