// Makes scenes of robots.
#include "harness/scene/robot/robot_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "harness/base/error.h"
#include "harness/base/input_file.h"
#include "harness/base/reproducible_math.h"
#include "harness/geometry/concave_bodies.h"
#include "harness/scene/body_reader.h"
#include "harness/scene/pair_filter.h"
#include "harness/scene/robot/configurations.h"
#include "harness/scene/robot/planning_scene.h"
#include "harness/scene/robot/robot.h"

namespace touchstone::scene {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t most_configurations = 1'000'000;
constexpr std::int64_t usual_steps = 32;  // of a path from start to goal

class RobotImporter {
 public:
  RobotImporter(files::TomlTable& table, const fs::path& urdf, MeshUse use,
                const SceneOverrides& overrides)
      : table_(table),
        folder_(fs::path(table.file()).parent_path()),
        urdf_(urdf),
        use_(use),
        overrides_(overrides) {}

  Scene import() {
    const fs::path srdf = table_.has("srdf") ? file_of("srdf", table_.text("srdf")) : fs::path();
    robot_ = read_robot(urdf_, srdf, read_packages());
    scene_.files = robot_.files;
    std::map<std::string, double> values = read_joints();
    if (table_.has("place")) {
      files::TomlTable place = table_.inside("place", "place");
      base_ = read_pose(place);
      place.finish();
    }
    PlanningScene around;
    if (table_.has("obstacles")) {
      obstacles_ = file_of("obstacles", table_.text("obstacles"));
      scene_.files.push_back(obstacles_);
      around = read_planning_scene(obstacles_);
      base_ = base::placed(around.base, base_);
    }
    for (const auto& [name, value] : around.joints) {
      if (robot_.find_joint(name)) values.emplace(name, value);
    }
    usual_ = usual_configuration(robot_, values);
    const std::vector<Configuration> configurations = read_configurations_key();
    add_links();
    follow(configurations);
    for (Obstacle& obstacle : around.obstacles) add_obstacle(std::move(obstacle));
    ignore_links();
    const std::map<std::string, std::vector<std::uint32_t>> named = bodies_by_name(scene_);
    for (const auto& [first, second] : around.allowed) {
      const auto a = named.find(first), b = named.find(second);
      if (a != named.end() && b != named.end()) ignore_pairs(a->second, b->second, scene_.filter);
    }
    sort_ignored(scene_.filter);
    if (scene_.tracks.bodies.empty()) {
      throw base::InputError(urdf_.string(), 0, "no link has a shape; expected <collision>");
    }
    return std::move(scene_);
  }

  bool draws() const { return draws_; }

 private:
  fs::path file_of(std::string_view key, const std::string& name) const {
    const fs::path file = folder_ / name;
    std::error_code error;
    if (!fs::is_regular_file(file, error)) table_.fail(key, "no file " + file.string());
    return file;
  }

  Packages read_packages() {
    Packages packages;
    const toml::node* node = table_.node("packages");
    if (node == nullptr) return packages;
    if (node->is_table()) {
      files::TomlTable named = table_.inside("packages", "packages");
      for (const std::string& name : named.keys()) {
        packages.named.emplace(name, folder_ / named.text(name));
      }
    } else {
      for (const std::string& folder : table_.texts("packages", {})) {
        packages.folders.push_back(folder_ / folder);
      }
    }
    return packages;
  }

  std::uint32_t joint_of(std::string_view key, const std::string& name) const {
    const auto joint = robot_.find_joint(name);
    if (!joint || !robot_.joints[*joint].moves()) {
      table_.fail(key, fmt::format("found \"{}\"; expected a joint of the robot that moves",
                                   base::shortened(name)));
    }
    return *joint;
  }

  // A named configuration of SRDF, or values by joint.
  std::map<std::string, double> read_joints() {
    std::map<std::string, double> values;
    const toml::node* node = table_.node("joints");
    if (node == nullptr) return values;
    if (node->is_string()) {
      const std::string name = table_.text("joints");
      const auto state = robot_.states.find(name);
      if (state == robot_.states.end()) {
        std::string known;
        for (const auto& [other, unused] : robot_.states)
          known += (known.empty() ? "" : ", ") + other;
        table_.fail("joints",
                    fmt::format("found \"{}\"; expected a group state of the SRDF file: {}",
                                base::shortened(name), known.empty() ? "there is none" : known));
      }
      return state->second;
    }
    files::TomlTable joints = table_.inside("joints", "joints");
    for (const std::string& name : joints.keys()) {
      joint_of("joints", name);
      values[name] = joints.number(name, {.low = -1e9, .high = 1e9});
    }
    return values;
  }

  std::vector<Configuration> read_configurations_key() {
    const toml::node* node = table_.node("configurations");
    std::vector<std::string> held = table_.texts("held", {});
    if (node == nullptr) {
      expect_none(held);
      return {usual_.values};
    }
    if (node->is_string()) {
      expect_none(held);
      return from_file(table_, "configurations", usual_steps);
    }
    files::TomlTable given = table_.inside("configurations", "configurations");
    std::vector<Configuration> configurations;
    if (given.has("file")) {
      const std::int64_t steps = given.integer("steps", 1, most_configurations, usual_steps);
      expect_none(held);
      configurations = from_file(given, "file", steps);
    } else {
      configurations = at_random(given, held);
    }
    given.finish();
    return configurations;
  }

  void expect_none(const std::vector<std::string>& held) const {
    if (!held.empty()) table_.fail("held", "without random configurations; expected none");
  }

  std::vector<Configuration> from_file(files::TomlTable& given, std::string_view key,
                                       std::int64_t steps) {
    const fs::path file = file_of("configurations", given.text(key));
    scene_.files.push_back(file);
    const bool is_request = is_yaml(file);
    if (!is_request && key == "file" && given.contains("steps")) {
      given.fail("steps", "of a file whose rows are the configurations; expected none");
    }
    if (is_request) {
      const MotionRequest request = read_request(file, robot_);
      return straight_path(robot_, with_values(robot_, usual_, request.start),
                           with_values(robot_, usual_, request.goal),
                           static_cast<std::size_t>(steps));
    }
    TimedConfigurations read = read_configurations(file, robot_, usual_);
    if (read.time_step > 0) scene_.motion.time_step = read.time_step;
    return std::move(read.frames);
  }

  std::vector<Configuration> at_random(files::TomlTable& given,
                                       const std::vector<std::string>& held) {
    const bool walks = given.contains("walk");
    if (walks == given.contains("random")) {
      given.fail(walks ? "walk" : "random", "expected one of file, random and walk");
    }
    RandomConfigurations request;
    request.count =
        static_cast<std::size_t>(given.integer(walks ? "walk" : "random", 1, most_configurations));
    const std::int64_t seed = given.integer("seed", 0, INT64_MAX, 1);
    request.seed = static_cast<std::uint64_t>(overrides_.seed == -1 ? seed : overrides_.seed);
    if (walks) request.step = given.number("step", {.low = 1e-9, .high = 1}, 0.05);
    for (const Joint& joint : robot_.joints) request.moves.push_back(joint.is_free() ? 1 : 0);
    for (const std::string& name : held) {
      const std::uint32_t joint = joint_of("held", name);
      if (!robot_.joints[joint].is_free()) {
        table_.fail("held", fmt::format("\"{}\" follows another joint; expected that one",
                                        base::shortened(name)));
      }
      request.moves[joint] = 0;
    }
    for (std::size_t i = 0; walks && i < request.moves.size(); ++i) {
      const Joint& joint = robot_.joints[i];
      const double value = usual_.values[i];
      if (request.moves[i] == 0 || (value >= joint.lower && value <= joint.upper)) continue;
      table_.fail("joints",
                  fmt::format("{} = {}, where a walk begins; expected {} to {}",
                              base::shortened(joint.name), value, joint.lower, joint.upper));
    }
    draws_ = true;
    return random_configurations(robot_, usual_, request);
  }

  // Returns the number of the shape of a mesh, which is read once for each scale.
  std::uint32_t mesh_of(const LinkShape& shape) {
    const Vec3d& scale = shape.scale;
    const auto [at, is_new] =
        meshes_.try_emplace({shape.mesh.string(), scale.x(), scale.y(), scale.z()});
    if (!is_new) return at->second;
    geometry::Mesh mesh = geometry::read_mesh(shape.mesh);
    scene_.files.push_back(shape.mesh);
    for (Vec3d& vertex : mesh.vertices) vertex = vertex.cwiseProduct(scale).eval();
    // A mirror turns the triangles inside out.
    if (scale.prod() < 0) {
      for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
    }
    at->second = add_mesh(std::move(mesh), urdf_.string(), shape.line);
    return at->second;
  }

  std::uint32_t add_mesh(geometry::Mesh mesh, const std::string& file, std::int64_t line) {
    if (!std::ranges::all_of(mesh.vertices, [](const Vec3d& v) { return v.allFinite(); })) {
      throw base::InputError(file, line, "not finite at its scale; expected a smaller one");
    }
    const MeshUse use = mesh.triangles.empty() ? MeshUse::hull : use_;
    if (use == MeshUse::solid && geometry::open_edge(mesh.vertices, mesh.triangles)) {
      throw base::InputError(file, line,
                             "a solid, and the surface of the mesh is open; expected a closed one, "
                             "or meshes = \"surface\"");
    }
    const ConcaveShape made = mesh_shape(std::move(mesh), use);
    return scene_.add_shape(made.hull, made.mesh, made.body);
  }

  void add_body(std::uint32_t shape, const Pose& pose, bool moves, const std::string& name) {
    Body body;
    body.shape = shape;
    body.pose = pose;
    body.moving = moves;
    scene_.bodies.push_back(body);
    scene_.names.push_back(name);
  }

  void add_links() {
    for (const Link& link : robot_.links) {
      for (const LinkShape& shape : link.shapes) {
        add_body(shape.mesh.empty() ? scene_.add_shape(shape.shape) : mesh_of(shape), Pose{}, true,
                 link.name);
      }
    }
  }

  void follow(const std::vector<Configuration>& configurations) {
    Tracks& tracks = scene_.tracks;
    for (std::uint32_t i = 0; i < scene_.bodies.size(); ++i) tracks.bodies.push_back(i);
    for (const Configuration& values : configurations) {
      const std::vector<Pose> links = link_poses(robot_, values, base_);
      for (std::size_t i = 0; i < robot_.links.size(); ++i) {
        for (const LinkShape& shape : robot_.links[i].shapes) {
          const Pose pose = base::placed(links[i], shape.pose);
          if (!pose.rotation.allFinite() || !pose.translation.allFinite()) {
            throw base::InputError(urdf_.string(), shape.line,
                                   "is not at a finite place in a configuration; expected smaller "
                                   "values");
          }
          tracks.poses.push_back(pose);
        }
      }
    }
    for (std::size_t i = 0; i < scene_.bodies.size(); ++i) scene_.bodies[i].pose = tracks.poses[i];
    scene_.frames = static_cast<int>(configurations.size());
  }

  void add_obstacle(Obstacle obstacle) {
    if (robot_.find_link(obstacle.name)) {
      throw base::InputError(obstacles_.string(), obstacle.line,
                             fmt::format("an object has the name of the link \"{}\"; expected "
                                         "another",
                                         base::shortened(obstacle.name)));
    }
    const std::uint32_t shape =
        obstacle.mesh ? add_mesh(std::move(*obstacle.mesh), obstacles_.string(), obstacle.line)
                      : scene_.add_shape(obstacle.shape);
    add_body(shape, base::placed(frame_of(obstacle), obstacle.pose), false, obstacle.name);
  }

  // The frame is the world's, or that of a link that stands still with the root.
  Pose frame_of(const Obstacle& obstacle) const {
    if (obstacle.frame == "world") return {};
    const auto link = robot_.find_link(obstacle.frame);
    std::uint32_t at = link.value_or(robot_.root);
    for (auto joint = robot_.joints.rbegin(); joint != robot_.joints.rend(); ++joint) {
      if (joint->child == at && !joint->moves()) at = joint->parent;
    }
    if (!link || at != robot_.root) {
      throw base::InputError(
          obstacles_.string(), obstacle.line,
          fmt::format("frame_id \"{}\"; expected world or a link that is fixed to the root",
                      base::shortened(obstacle.frame)));
    }
    return link_poses(robot_, usual_.values, base_)[*link];
  }

  void ignore_links() {
    std::vector<std::vector<std::uint32_t>> bodies(robot_.links.size());
    std::uint32_t next = 0;
    for (std::size_t i = 0; i < robot_.links.size(); ++i) {
      for (std::size_t k = 0; k < robot_.links[i].shapes.size(); ++k) bodies[i].push_back(next++);
    }
    for (const auto& own : bodies) ignore_pairs(own, own, scene_.filter);
    for (const auto* pairs : {&robot_.joined, &robot_.disabled}) {
      for (const IndexPair& pair : *pairs) {
        ignore_pairs(bodies[pair.a], bodies[pair.b], scene_.filter);
      }
    }
  }

  files::TomlTable& table_;
  fs::path folder_, urdf_, obstacles_;
  MeshUse use_;
  const SceneOverrides& overrides_;
  Robot robot_;
  UsualConfiguration usual_;
  bool draws_ = false;
  Pose base_;
  Scene scene_;
  std::map<std::tuple<std::string, double, double, double>, std::uint32_t> meshes_;
};

}  // namespace

Scene import_robot(files::TomlTable& table, const fs::path& urdf, MeshUse use,
                   const SceneOverrides& overrides, bool& draws) {
  RobotImporter importer(table, urdf, use, overrides);
  Scene scene = importer.import();
  draws = importer.draws();
  return scene;
}

}  // namespace touchstone::scene
