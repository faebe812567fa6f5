// Reads scene files: chooses a generator, listed bodies or an import, and checks the result.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "algorithms/core/bounds.h"
#include "harness/files/toml_table.h"
#include "harness/geometry/tessellation.h"
#include "harness/models/model.h"
#include "harness/scene/body_reader.h"
#include "harness/scene/box_frames.h"
#include "harness/scene/generators/generators.h"
#include "harness/scene/generators/options.h"
#include "harness/scene/model_scene.h"
#include "harness/scene/pair_filter.h"
#include "harness/scene/pose_log.h"
#include "harness/scene/rigid_ipc.h"
#include "harness/scene/robot/robot_scene.h"
#include "harness/scene/scene.h"
#include "harness/scene/shape_reader.h"

namespace touchstone::scene {

void append(Scene from, Scene& to) {
  const auto shapes = static_cast<std::uint32_t>(to.shapes.size());
  const auto bodies = static_cast<std::uint32_t>(to.bodies.size());
  for (std::size_t i = 0; i < from.shapes.size(); ++i) {
    to.add_shape(std::move(from.shapes[i]), i < from.meshes.size() ? from.meshes[i] : nullptr,
                 i < from.concave.size() ? from.concave[i] : nullptr);
  }
  for (Body body : from.bodies) {
    body.shape += shapes;
    to.bodies.push_back(body);
  }
  if (!to.names.empty() || !from.names.empty()) {
    to.names.resize(bodies);
    from.names.resize(from.bodies.size());
    std::ranges::move(from.names, std::back_inserter(to.names));
  }
  std::ranges::move(from.files, std::back_inserter(to.files));
  for (const IndexPair& pair : from.filter.ignored) {
    to.filter.ignored.push_back({pair.a + bodies, pair.b + bodies});
  }
  if (from.tracks.bodies.empty()) return;
  const std::size_t frames = std::max(to.tracks.frames(), from.tracks.frames());
  Tracks both;
  for (std::size_t frame = 0; frame < frames; ++frame) {
    for (const Tracks* one : {&to.tracks, &from.tracks}) {
      if (one->bodies.empty()) continue;
      const std::size_t width = one->bodies.size();
      const auto first = one->poses.begin() +
                         static_cast<std::ptrdiff_t>(width * std::min(frame, one->frames() - 1));
      both.poses.insert(both.poses.end(), first, first + static_cast<std::ptrdiff_t>(width));
    }
  }
  both.bodies = std::move(to.tracks.bodies);
  for (const std::uint32_t body : from.tracks.bodies) both.bodies.push_back(body + bodies);
  to.tracks = std::move(both);
}

namespace {

constexpr std::int64_t most_bodies = 100'000'000;
constexpr std::int64_t most_frames = 1'000'000;
constexpr int generated_frames = 10;
constexpr std::string_view robot_ending = ".urdf";
constexpr double broadmark_gravity = 0.0981;  // world sides per second squared
constexpr double broadmark_period = 6.2;      // seconds

constexpr std::string_view motion_names[] = {"inertial", "brownian", "free_fall",
                                             "rotating_gravity"};

std::uint64_t read_seed(files::TomlTable& table, const SceneOverrides& overrides) {
  const std::int64_t seed = table.integer("seed", 0, INT64_MAX, 1);
  const std::int64_t used = overrides.seed == -1 ? seed : overrides.seed;
  if (used < 0) {
    throw base::InputError(table.file(), 0,
                           fmt::format("a seed of {} was asked for; expected 0 or more", used));
  }
  return static_cast<std::uint64_t>(used);
}

// Reads `motion` and its parameters; the scene's own motion gives the defaults. `side` is the width
// of a generated world, and 0 for others.
void read_motion(files::TomlTable& table, double side, Motion& motion) {
  motion.time_step = table.number("time_step", {.low = 1e-9, .high = 1e6}, motion.time_step);
  motion.kind = static_cast<MotionKind>(
      table.choice("motion", motion_names, static_cast<std::size_t>(motion.kind)));
  if (motion.kind == MotionKind::free_fall || motion.kind == MotionKind::rotating_gravity) {
    const double factor = motion.kind == MotionKind::free_fall ? 1 : 4;
    const double fallback = side > 0 ? factor * broadmark_gravity * side : 9.81;
    motion.acceleration = table.number("acceleration", files::not_negative, fallback);
  }
  if (motion.kind == MotionKind::rotating_gravity) {
    motion.period = table.number("period", {.low = 1e-9, .high = 1e9}, broadmark_period);
  }
}

// Reads additions to listed and imported scenes: walls, and the parameters of brownian motion.
void read_motion_of_listed(files::TomlTable& table, const SceneOverrides& overrides, bool uses_seed,
                           Scene& scene) {
  Motion& motion = scene.motion;
  read_motion(table, 0, motion);
  if (motion.kind == MotionKind::brownian) {
    motion.speed = table.number("speed", files::not_negative, 1.0);
    motion.seed = read_seed(table, overrides);
  } else if (!uses_seed) {
    refuse_seed(table.file(), overrides.seed);
  }
  if (!table.has("wall_min") && !table.has("wall_max")) return;
  motion.wall_min = table.vector("wall_min", files::any_number);
  motion.wall_max = table.vector("wall_max", files::any_number);
  for (int axis = 0; axis < 3; ++axis) {
    if (motion.wall_min[axis] > motion.wall_max[axis]) {
      table.fail("wall_max", fmt::format("found {} below wall_min {}; expected min <= max",
                                         motion.wall_max[axis], motion.wall_min[axis]));
    }
  }
}

int frames_of_pairs(files::TomlTable& table, const SceneOverrides& overrides) {
  const std::int64_t asked = table.integer("frames", 1, most_frames, 1);
  return overrides.frames == -1 ? static_cast<int>(asked) : overrides.frames;
}

Scene generate(files::TomlTable& table, ShapeReader& shapes, const SceneOverrides& overrides) {
  std::vector<std::string_view> names;
  for (const Generator& generator : generators()) names.push_back(generator.name);
  const Generator& generator = generators()[table.choice("generator", names)];
  std::int64_t count = table.integer("count", 1, most_bodies, 1000);
  if (overrides.count != -1) count = overrides.count;
  if (count < 1 || count > most_bodies) {
    throw base::InputError(
        table.file(), 0,
        fmt::format("a count of {} was asked for; expected 1 to {}", count, most_bodies));
  }
  if (generator.name != "pairs") refuse_gap(table.file(), overrides.gap);
  GeneratorInput input{table, shapes, count, read_seed(table, overrides), overrides.gap};
  if (generator.name == "pairs") input.frames = frames_of_pairs(table, overrides);
  input.moving = overrides.moving;
  Generated made = generator.make(input);
  if (!input.takes_moving) refuse_moving(table.file(), overrides.moving);
  made.scene.motion.seed = input.random(GeneratorInput::motion_stream).next();
  read_motion(table, made.side, made.scene.motion);
  read_step(table, made.scene);
  read_order(input, made.scene);
  read_exchange(input, made.scene);
  return std::move(made.scene);
}

Scene load_recording(const std::filesystem::path& file) {
  Scene scene;
  scene.recording = read_aabbs(file).frames;
  scene.frames = static_cast<int>(scene.recording.size());
  return scene;
}

Scene import_scene(const std::filesystem::path& file, const MeshUses& uses) {
  const MeshUse use = uses.instead.value_or(uses.own.value_or(MeshUse::surface));
  if (file.extension() == ".json") return import_rigid_ipc(file, use);
  if (models::is_model_file(file)) return import_model(file, use);
  if (file.extension() == ".aabbs") return load_recording(file);
  throw base::InputError(
      file.string(), 0,
      file.extension() == ".jsonl"
          ? "holds single pairs; `touchstone query FILE --page OUT.html` draws them"
      : file.extension() == ".xacro"
          ? "macros of a robot; expected an expanded file: `xacro FILE > robot.urdf`"
          : "unknown kind of file; expected .toml, .json (rigid-ipc), .urdf (a robot), .aabbs "
            "(Broadmark) or a model (.glb, .gltf, .dae, .fbx, .3ds)");
}

// Sets the number of frames; for a recording it keeps the first ones.
void set_frames(const std::string& file, std::int64_t line, std::int64_t frames, Scene& scene) {
  const auto recorded = static_cast<std::int64_t>(scene.recording.size());
  const auto tracked = static_cast<std::int64_t>(scene.tracks.frames());
  const std::int64_t most = recorded > 0 ? recorded : tracked > 1 ? tracked : most_frames;
  if (frames < 1 || frames > most) {
    throw base::InputError(file, line, fmt::format("{} frames; expected 1 to {}", frames, most));
  }
  scene.frames = static_cast<int>(frames);
  if (recorded > 0) scene.recording.resize(static_cast<std::size_t>(frames));
  if (frames < tracked) {
    scene.tracks.poses.resize(scene.tracks.bodies.size() * static_cast<std::size_t>(frames));
  }
}

// Bodies of a scene that is imported have others behind them, which come and go with none.
void expect_stay(const std::filesystem::path& file, const Scene& scene) {
  if (scene.motion.churn == 0 && scene.motion.teleports == 0 && scene.pairs.empty()) return;
  throw base::InputError(
      file.string(), 0,
      "is imported, and its bodies come and go, jump or are pairs; expected bodies that stay");
}

constexpr int deepest_import = 8;

Scene read_toml(const toml::table& content, const std::filesystem::path& path,
                const SceneOverrides& overrides, std::vector<std::int64_t>& lines,
                std::optional<MeshUse> instead = {}, int depth = 0);

// `lines` receives the lines of listed bodies. `instead`, of a file that imports this one, replaces
// what meshes are.
Scene read_toml(const std::filesystem::path& path, const SceneOverrides& overrides,
                std::vector<std::int64_t>& lines, std::optional<MeshUse> instead = {},
                int depth = 0) {
  if (depth > deepest_import) {
    throw base::InputError(
        path.string(), 0,
        fmt::format("imported by {} scenes in a row, perhaps by itself; expected "
                    "at most {}",
                    depth, deepest_import));
  }
  return read_toml(files::parse_toml(path), path, overrides, lines, instead, depth);
}

Scene read_toml(const toml::table& content, const std::filesystem::path& path,
                const SceneOverrides& overrides, std::vector<std::int64_t>& lines,
                std::optional<MeshUse> instead, int depth) {
  const std::string file = path.string();
  files::TomlTable table(content, file, "");
  const MeshUses uses = read_mesh_uses(table, instead);
  ShapeReader shapes(path.parent_path(), table.text("get", ""), uses);
  const bool imports = table.contains("import"), lists = table.contains("body");
  const bool generates = table.contains("generator");
  if (!imports && !lists && !generates) {
    table.fail("scene", "missing; expected generator = \"...\", [[body]] or import = \"...\"");
  }

  // Generated bodies come last, since those that arrive later are the last ones.
  Scene scene;
  int frames = 1;
  bool is_robot = false, robot_draws = false, asks_fixed = true;
  for (const std::string& name : table.texts("import", {})) {
    const std::filesystem::path imported = shapes.existing_file(
        table, "import", name, "a .toml, .json, .urdf or .aabbs file or a model");
    Scene one;
    if (imported.extension() == robot_ending) {
      if (std::exchange(is_robot, true)) {
        table.fail("import", "a second robot; expected one, whose keys are those of the file");
      }
      const MeshUse use = uses.instead.value_or(uses.own.value_or(MeshUse::surface));
      one = import_robot(table, imported, use, overrides, robot_draws);
    } else if (imported.extension() == ".toml") {
      std::vector<std::int64_t> theirs;
      one = read_toml(imported, {}, theirs, uses.instead ? uses.instead : uses.own, depth + 1);
      expect_stay(imported, one);
    } else {
      one = import_scene(imported, uses);
    }
    frames = std::max(frames, one.frames);
    asks_fixed = asks_fixed && one.filter.rests.empty();
    if (imported.extension() != robot_ending) one.files.push_back(imported);
    if (scene.bodies.empty() && scene.recording.empty()) {
      scene = std::move(one);
    } else {
      if (!one.recording.empty()) scene.recording = std::move(one.recording);
      append(std::move(one), scene);
    }
    if (!scene.recording.empty() && (!scene.bodies.empty() || lists || generates)) {
      table.fail("import", "a recording of boxes beside bodies; expected it alone");
    }
  }
  if (lists) lines = read_bodies(table, shapes, scene);
  if (generates) {
    Scene made = generate(table, shapes, overrides);
    const bool has_others = imports || lists;
    if (has_others && !made.pairs.empty()) {
      table.fail("generator", "found \"pairs\" beside other bodies; expected it alone");
    }
    if (!imports) frames = made.pairs.empty() ? generated_frames : 1;
    if (has_others) {
      if (scene.motion.kind != MotionKind::inertial) {
        table.fail("generator",
                   "given beside an import that has a motion of its own; expected one");
      }
      if (!table.contains("time_step") && imports) made.motion.time_step = scene.motion.time_step;
    }
    scene.motion = made.motion;
    if (has_others) {
      append(std::move(made), scene);
    } else {
      scene = std::move(made);
    }
  } else {
    if (!table.boolean("moving", true)) {
      for (std::uint32_t i = 0; i < scene.bodies.size(); ++i) {
        if (!std::ranges::binary_search(scene.tracks.bodies, i)) scene.bodies[i].moving = false;
      }
    }
    refuse_for_listed(file, overrides);
    if (scene.recording.empty()) {
      read_motion_of_listed(table, overrides, robot_draws, scene);
    } else {
      refuse_seed(file, overrides.seed);
    }
  }
  if (scene.recording.empty() && scene.pairs.empty() && table.has("poses")) {
    if (scene.motion.churn > 0 || scene.motion.teleports > 0) {
      table.fail("poses", "given beside teleports or churn; expected bodies that stay");
    }
    scene.files.push_back(shapes.existing_file(table, "poses", "a .csv file of poses"));
    read_pose_log(scene.files.back(), scene);
    frames = scene.frames;
  }
  if (scene.recording.empty() && scene.pairs.empty()) {
    read_filter(table, !is_robot && asks_fixed, scene);
  }
  if (!scene.tracks.bodies.empty()) frames = static_cast<int>(scene.tracks.frames());
  for (std::filesystem::path& mesh : shapes.files()) scene.files.push_back(std::move(mesh));
  scene.name = table.text("name", path.stem().string());
  const std::int64_t asked = table.integer("frames", 1, most_frames, frames);
  if (overrides.frames == -1) {
    set_frames(file, table.line("frames"), asked, scene);
  } else {
    set_frames(file, 0, overrides.frames, scene);
  }
  if (scene.recording.empty() && table.has("polytope")) {
    const int level = static_cast<int>(table.integer("polytope", 0, 5));
    for (Shape& shape : scene.shapes) {
      if (shape.kind != ShapeKind::halfspace) shape = geometry::as_polytope(shape, level);
    }
  }
  table.finish();
  return scene;
}

// Throws if a box may leave the range of float in any frame.
void check_range(const std::string& file, std::span<const std::int64_t> lines, const Scene& scene) {
  constexpr double most = 1e38;
  const Motion& motion = scene.motion;
  const double time = motion.time_step * scene.frames;
  std::vector<double> reach;  // doubled, because rotations are correct only to a thousandth
  for (const Shape& shape : scene.shapes) {
    const bool bounded = shape.kind != ShapeKind::halfspace;
    reach.push_back(bounded ? 2 * loose_reach(shape, Mat3d::Identity()) : 0);
  }
  // The place among the tracks; behind all of them for a body without one.
  const auto tracked = [&scene](std::size_t body) {
    const std::vector<std::uint32_t>& bodies = scene.tracks.bodies;
    const auto at = std::ranges::lower_bound(bodies, body);
    return at != bodies.end() && *at == body ? static_cast<std::size_t>(at - bodies.begin())
                                             : scene.tracks.poses.size();
  };
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Body& body = scene.bodies[i];
    double farthest = body.pose.translation.cwiseAbs().maxCoeff() + reach[body.shape];
    if (body.moving) {
      const double speed = std::max(body.velocity.cwiseAbs().maxCoeff(), motion.speed);
      farthest += (speed + motion.acceleration * time) * time;
    }
    for (std::size_t at = tracked(i); at < scene.tracks.poses.size();
         at += scene.tracks.bodies.size()) {
      farthest = std::max(
          farthest, scene.tracks.poses[at].translation.cwiseAbs().maxCoeff() + reach[body.shape]);
    }
    const double turn = body.angular_velocity.cwiseAbs().maxCoeff() * time;
    if (farthest <= most && turn <= most) continue;
    throw base::InputError(
        file, i < lines.size() ? lines[i] : 0,
        fmt::format("body {} reaches {:.3g} m and turns by {:.3g}; expected less than "
                    "{:g}, for boxes are in float",
                    i + 1, farthest, turn, most));
  }
}

// Throws unless moving bodies start between the walls.
void check_walls(const std::string& file, std::span<const std::int64_t> lines, const Scene& scene) {
  const Motion& motion = scene.motion;
  if (!(motion.wall_min.x() <= motion.wall_max.x())) return;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    if (!scene.bodies[i].moving || std::ranges::binary_search(scene.tracks.bodies, i)) continue;
    for (int axis = 0; axis < 3; ++axis) {
      const double x = scene.bodies[i].pose.translation[axis];
      if (x >= motion.wall_min[axis] && x <= motion.wall_max[axis]) continue;
      throw base::InputError(
          file, i < lines.size() ? lines[i] : 0,
          fmt::format("body {} starts at {} = {}; expected a place between the walls "
                      "{} and {}",
                      i + 1, "xyz"[axis], x, motion.wall_min[axis], motion.wall_max[axis]));
    }
  }
}

void expect_playable(const std::string& file, std::span<const std::int64_t> lines,
                     const Scene& scene) {
  if (scene.size() == 0) throw base::InputError(file, 0, "no bodies; expected at least one");
  check_range(file, lines, scene);
  check_walls(file, lines, scene);
}

}  // namespace

Scene load_scene(const std::filesystem::path& path, const SceneOverrides& overrides) {
  const std::string file = path.string();
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    throw base::InputError(
        file, 0, "no such file; expected a scene: .toml, .json, .urdf, .aabbs or a model");
  }
  Scene scene;
  std::vector<std::int64_t> lines;
  if (path.extension() == ".toml") {
    scene = read_toml(path, overrides, lines);
  } else if (path.extension() == robot_ending) {
    const toml::table nothing;
    files::TomlTable table(nothing, file, "");
    bool draws = false;
    scene = import_robot(table, path, MeshUse::surface, overrides, draws);
    scene.name = path.stem().string();
    refuse_for_listed(file, overrides);
    refuse_seed(file, overrides.seed);
    ignore_fixed_pairs(scene);
    if (overrides.frames != -1) set_frames(file, 0, overrides.frames, scene);
  } else {
    scene = import_scene(path, {});
    refuse_for_listed(file, overrides);
    refuse_seed(file, overrides.seed);
    scene.name = path.stem().string();
    if (overrides.frames != -1) set_frames(file, 0, overrides.frames, scene);
  }
  if (path.extension() != robot_ending) scene.files.push_back(path);
  if (overrides.gap) {
    const double gap = *overrides.gap;
    scene.name += fmt::format(" {} {}", gap < 0 ? "depth" : "gap", std::abs(gap));
  }
  expect_playable(file, lines, scene);
  return scene;
}

Scene scene_of_text(const std::string& text, const std::filesystem::path& path) {
  std::vector<std::int64_t> lines;
  Scene scene = read_toml(toml::parse(text), path, {}, lines);
  expect_playable(path.string(), lines, scene);
  return scene;
}

}  // namespace touchstone::scene
