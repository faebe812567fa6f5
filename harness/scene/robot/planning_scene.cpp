// Reads planning scenes and requests from YAML.
#include "harness/scene/robot/planning_scene.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string_view>

#include "harness/base/input_file.h"
#include "harness/base/reproducible_math.h"
#include "harness/scene/robot/configurations.h"
#include "harness/scene/robot/yaml_node.h"

namespace touchstone::scene {
namespace {

// shape_msgs/SolidPrimitive: `type` as a name or its number, and `dimensions`.
Shape read_primitive(const YamlNode& node) {
  constexpr std::array<std::string_view, 4> names = {"box", "sphere", "cylinder", "cone"};
  const YamlNode type = node.required("type");
  const std::string name = type.text();
  std::size_t kind = 0;
  while (kind < names.size() && name != names[kind] && name != std::to_string(kind + 1)) ++kind;
  if (kind == names.size()) {
    type.fail(
        fmt::format("type \"{}\"; expected box, sphere, cylinder or cone", base::shortened(name)));
  }
  constexpr std::array<std::size_t, 4> counts = {3, 1, 2, 2};
  const YamlNode dimensions = node.required("dimensions");
  std::vector<double> sizes;
  for (const YamlNode& size : dimensions.elements()) {
    sizes.push_back(size.number());
    if (sizes.back() < 0) size.fail(fmt::format("found {}; expected 0 or more", sizes.back()));
  }
  if (sizes.size() != counts[kind]) {
    dimensions.fail(fmt::format("found {} dimensions of a {}; expected {}", sizes.size(),
                                names[kind], counts[kind]));
  }
  Shape shape;
  switch (kind) {
    case 0:
      shape.kind = ShapeKind::box;
      shape.half_extents = 0.5 * Vec3d(sizes[0], sizes[1], sizes[2]);
      break;
    case 1:
      shape.kind = ShapeKind::sphere;
      shape.radius = sizes[0];
      break;
    default:  // height, radius
      shape.kind = kind == 2 ? ShapeKind::cylinder : ShapeKind::cone;
      shape.half_length = 0.5 * sizes[0];
      shape.radius = sizes[1];
      break;
  }
  return shape;
}

geometry::Mesh read_triangles(const YamlNode& node) {
  geometry::Mesh mesh;
  for (const YamlNode& vertex : node.required("vertices").elements()) {
    const std::vector<double> xyz = vertex.numbers({"x", "y", "z"});
    mesh.vertices.emplace_back(xyz[0], xyz[1], xyz[2]);
  }
  const auto last = static_cast<std::int64_t>(mesh.vertices.size()) - 1;
  for (const YamlNode& triangle : node.required("triangles").elements()) {
    std::array<std::uint32_t, 3> corners{};
    const std::vector<YamlNode> indices = triangle.required("vertex_indices").elements();
    if (indices.size() != corners.size()) triangle.fail("expected three vertex_indices");
    for (std::size_t i = 0; i < corners.size(); ++i) {
      corners[i] = static_cast<std::uint32_t>(indices[i].integer(0, last));
    }
    mesh.triangles.push_back(corners);
  }
  if (mesh.triangles.empty()) node.fail("no triangles; expected at least one");
  return mesh;
}

// Adds `name` and `position` of a joint state.
void read_values(const YamlNode& state, std::map<std::string, double>& values) {
  const std::vector<YamlNode> names = state.elements("name");
  const std::vector<YamlNode> positions = state.elements("position");
  if (names.size() != positions.size()) {
    state.fail(
        fmt::format("{} names and {} positions; expected as many", names.size(), positions.size()));
  }
  for (std::size_t i = 0; i < names.size(); ++i) values[names[i].text()] = positions[i].number();
}

class PlanningSceneReader {
 public:
  PlanningScene read(const YamlNode& top) {
    constexpr std::array keys = {"world", "robot_state", "allowed_collision_matrix"};
    if (std::ranges::none_of(keys, [&](const char* key) { return top.find(key).has_value(); })) {
      top.fail(
          fmt::format("no key of a planning scene; expected some of {}", fmt::join(keys, ", ")));
    }
    top.warn_of_slips({"world", "robot_state", "allowed_collision_matrix", "link_padding",
                       "link_scale", "name", "robot_model_name", "fixed_frame_transforms",
                       "object_colors", "is_diff"});
    if (const auto state = top.find("robot_state")) read_state(*state);
    if (const auto world = top.find("world")) {
      world->warn_of_slips({"collision_objects", "octomap"});
      for (const YamlNode& object : world->elements("collision_objects")) read_object(object);
      const auto around = world->find("octomap");
      const auto map = around ? around->find("octomap") : around;
      if (map && !map->elements("data").empty()) {
        map->fail("an octomap; expected primitives and meshes");
      }
    }
    if (const auto matrix = top.find("allowed_collision_matrix")) read_matrix(*matrix);
    for (const auto& [key, neutral] :
         {std::pair{"link_padding", 0.0}, std::pair{"link_scale", 1.0}}) {
      for (const YamlNode& link : top.elements(key)) {
        const char* const value_key = neutral == 0 ? "padding" : "scale";
        const YamlNode value = link.required(value_key);
        if (value.number() != neutral) {
          value.fail(fmt::format("{}: found {}; expected {}, links as they are", key,
                                 value.number(), neutral));
        }
      }
    }
    return std::move(scene_);
  }

 private:
  void read_state(const YamlNode& state) {
    state.warn_of_slips(
        {"joint_state", "multi_dof_joint_state", "attached_collision_objects", "is_diff"});
    for (const YamlNode& object : state.elements("attached_collision_objects")) {
      object.fail("an attached object; expected objects of the world alone");
    }
    if (const auto values = state.find("joint_state")) read_values(*values, scene_.joints);
    const auto joints = state.find("multi_dof_joint_state");
    if (!joints) return;
    const std::vector<YamlNode> transforms = joints->elements("transforms");
    if (transforms.size() > 1) transforms[1].fail("a second transform; expected that of the base");
    if (!transforms.empty()) scene_.base = transforms[0].pose();
  }

  void read_object(const YamlNode& object) {
    object.warn_of_slips({"id", "header", "pose", "type", "primitives", "primitive_poses", "meshes",
                          "mesh_poses", "planes", "plane_poses", "subframe_names", "subframe_poses",
                          "operation"});
    const std::string name = object.required("id").text();
    for (const YamlNode& plane : object.elements("planes")) {
      plane.fail("a plane; expected primitives and meshes");
    }
    std::string frame;
    if (const auto header = object.find("header")) {
      header->warn_of_slips({"frame_id", "seq", "stamp"});
      if (const auto given = header->find("frame_id")) frame = given->text();
    }
    if (frame.empty()) frame = "world";
    const auto own = object.find("pose");
    const Pose around = own ? own->pose() : Pose{};
    read_shapes(object, "primitives", "primitive_poses", [&](const YamlNode& shape, Pose pose) {
      scene_.obstacles.push_back({name, read_primitive(shape), std::nullopt, frame,
                                  base::placed(around, pose), shape.line()});
    });
    read_shapes(object, "meshes", "mesh_poses", [&](const YamlNode& shape, Pose pose) {
      scene_.obstacles.push_back(
          {name, Shape{}, read_triangles(shape), frame, base::placed(around, pose), shape.line()});
    });
  }

  template <typename Add>
  static void read_shapes(const YamlNode& object, const char* shapes_key, const char* poses_key,
                          const Add& add) {
    const std::vector<YamlNode> shapes = object.elements(shapes_key);
    const std::vector<YamlNode> poses = object.elements(poses_key);
    if (shapes.size() != poses.size()) {
      object.fail(fmt::format("{} {} and {} {}; expected as many", shapes.size(), shapes_key,
                              poses.size(), poses_key));
    }
    for (std::size_t i = 0; i < shapes.size(); ++i) add(shapes[i], poses[i].pose());
  }

  void read_matrix(const YamlNode& matrix) {
    for (const YamlNode& value : matrix.elements("default_entry_values")) {
      if (value.text() != "false")
        value.fail("collisions that are allowed by default; expected none");
    }
    const std::vector<std::string> names = matrix.texts("entry_names");
    const std::vector<YamlNode> rows = matrix.elements("entry_values");
    if (rows.size() != names.size()) {
      matrix.fail(
          fmt::format("{} entry_values; expected {}, one a name", rows.size(), names.size()));
    }
    for (std::size_t i = 0; i < rows.size(); ++i) {
      // A row is a list, or a map with the key `enabled`.
      const std::vector<YamlNode> row = row_of(rows[i]);
      if (row.size() != names.size()) {
        rows[i].fail(fmt::format("{} values; expected {}", row.size(), names.size()));
      }
      for (std::size_t k = 0; k < row.size(); ++k) {
        const std::string value = row[k].text();
        if (value != "true" && value != "false") {
          row[k].fail(fmt::format("found \"{}\"; expected true or false", base::shortened(value)));
        }
        if (value == "true" && i < k) scene_.allowed.emplace_back(names[i], names[k]);
      }
    }
  }

  static std::vector<YamlNode> row_of(const YamlNode& row) {
    return row.is_list() ? row.elements() : row.required("enabled").elements();
  }

  PlanningScene scene_;
};

}  // namespace

bool is_yaml(const std::filesystem::path& file) {
  return file.extension() == ".yaml" || file.extension() == ".yml";
}

PlanningScene read_planning_scene(const std::filesystem::path& file) {
  return PlanningSceneReader().read(read_yaml(file, "a planning scene in YAML"));
}

MotionRequest read_request(const std::filesystem::path& file, const Robot& robot) {
  const YamlNode top = read_yaml(file, "a motion request in YAML");
  MotionRequest request;
  read_values(top.required("start_state").required("joint_state"), request.start);
  // A variant of the robot may lack some joints.
  std::erase_if(request.start, [&](const auto& one) { return !robot.find_joint(one.first); });
  request.goal = request.start;
  const YamlNode goals = top.required("goal_constraints");
  const std::vector<YamlNode> all = goals.elements();
  if (all.empty()) goals.fail("no goal; expected one with joint_constraints");
  const std::vector<YamlNode> joints = all.front().elements("joint_constraints");
  if (joints.empty()) all.front().fail("no joint_constraints; expected a goal in joint values");
  for (const YamlNode& joint : joints) {
    const YamlNode name = joint.required("joint_name");
    if (!robot.find_joint(name.text())) {
      name.fail(fmt::format("the robot has no joint \"{}\"; expected one that it has",
                            base::shortened(name.text())));
    }
    request.goal[name.text()] = joint.required("position").number();
  }
  return request;
}

}  // namespace touchstone::scene
