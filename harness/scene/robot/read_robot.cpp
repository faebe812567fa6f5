// Reads robots from URDF and SRDF.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <string_view>
#include <utility>

#include "harness/base/error.h"
#include "harness/base/input_file.h"
#include "harness/base/nearest_name.h"
#include "harness/base/reproducible_math.h"
#include "harness/geometry/mesh.h"
#include "harness/scene/robot/robot.h"
#include "harness/scene/robot/xml_element.h"

namespace touchstone::scene {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_links = 2'000;

template <typename Named>
std::optional<std::uint32_t> find_named(const std::vector<Named>& all, std::string_view name) {
  const auto at = std::ranges::find(all, name, &Named::name);
  if (at == all.end()) return std::nullopt;
  return static_cast<std::uint32_t>(at - all.begin());
}

// Returns the place of what an attribute names.
template <typename Named>
std::uint32_t expect_named(const std::vector<Named>& all, const XmlElement& element,
                           const char* attribute, std::string_view what) {
  const std::string name = element.text(attribute);
  const auto found = find_named(all, name);
  if (!found) {
    element.fail(
        fmt::format("no {} of the name \"{}\"; expected one", what, base::shortened(name)));
  }
  return *found;
}

bool is_file(const fs::path& file) {
  std::error_code error;
  return fs::is_regular_file(file, error);
}

void expect_expanded(const XmlElement& element) {
  for (const XmlElement& child : element.children()) {
    if (child.name().starts_with("xacro:")) {
      child.fail("a macro; expected an expanded file: `xacro FILE > robot.urdf`");
    }
    expect_expanded(child);
  }
}

class UrdfReader {
 public:
  UrdfReader(const fs::path& file, const Packages& packages)
      : file_(file), folder_(fs::absolute(file).parent_path()), packages_(packages) {}

  Robot read() {
    const XmlFile xml(file_, "robot");
    const XmlElement root = xml.root();
    expect_expanded(root);
    robot_.name = root.has("name") ? root.text("name") : file_.stem().string();
    const std::vector<XmlElement> links = root.children("link"), joints = root.children("joint");
    if (links.empty() || links.size() > most_links) {
      root.fail(fmt::format("{} links; expected 1 to {}", links.size(), most_links));
    }
    for (const XmlElement& link : links) read_link(link);
    for (const XmlElement& joint : joints) read_joint(joint);
    for (const XmlElement& joint : joints) read_mimic(joint);
    order_joints(root);
    robot_.files.push_back(file_);
    return std::move(robot_);
  }

 private:
  static Pose read_origin(const XmlElement& around) {
    const std::optional<XmlElement> origin = around.child("origin");
    if (!origin) return {};
    // Fixed axes: about x first, then y, then z.
    const Vec3d angles = origin->vector("rpy", Vec3d::Zero());
    const Mat3d about_x = base::rotation_over(Vec3d::UnitX(), angles.x());
    const Mat3d about_y = base::rotation_over(Vec3d::UnitY(), angles.y());
    const Mat3d about_z = base::rotation_over(Vec3d::UnitZ(), angles.z());
    return {base::product(about_z, base::product(about_y, about_x)),
            origin->vector("xyz", Vec3d::Zero())};
  }

  static double size(const XmlElement& element, const char* attribute) {
    const double value = element.number(attribute);
    if (value < 0) element.fail(fmt::format("{}: found {}; expected 0 or more", attribute, value));
    return value;
  }

  void read_link(const XmlElement& element) {
    Link link{.name = element.text("name"), .shapes = {}};
    if (robot_.find_link(link.name)) {
      element.fail(
          fmt::format("\"{}\" is there twice; expected it once", base::shortened(link.name)));
    }
    for (const XmlElement& collision : element.children("collision")) {
      const XmlElement geometry = collision.required("geometry");
      const std::vector<XmlElement> kinds = geometry.children();
      if (kinds.size() != 1) {
        geometry.fail(fmt::format("{} shapes in it; expected one", kinds.size()));
      }
      LinkShape shape = read_shape(kinds.front());
      shape.pose = read_origin(collision);
      shape.line = kinds.front().line();
      link.shapes.push_back(std::move(shape));
    }
    robot_.links.push_back(std::move(link));
  }

  LinkShape read_shape(const XmlElement& element) const {
    LinkShape read;
    Shape& shape = read.shape;
    const std::string kind = element.name();
    if (kind == "sphere") {
      shape.kind = ShapeKind::sphere;
      shape.radius = size(element, "radius");
    } else if (kind == "box") {
      shape.kind = ShapeKind::box;
      shape.half_extents = 0.5 * element.vector("size");
      if (shape.half_extents.minCoeff() < 0) element.fail("size: expected 0 or more");
    } else if (kind == "cylinder" || kind == "capsule") {
      shape.kind = kind == "capsule" ? ShapeKind::capsule : ShapeKind::cylinder;
      shape.radius = size(element, "radius");
      shape.half_length = 0.5 * size(element, "length");
    } else if (kind == "mesh") {
      read.mesh = mesh_file(element);
      if (!geometry::is_mesh_file(read.mesh)) {
        element.fail(
            fmt::format("filename: the format of \"{}\" is not read; expected .obj, .off, .stl, "
                        ".ply, .dae, .glb, .gltf, .fbx or .3ds",
                        base::shortened(read.mesh.string(), 400)));
      }
      read.scale = element.vector("scale", Vec3d::Ones());
      if (read.scale.cwiseAbs().minCoeff() == 0) element.fail("scale: found 0; expected another");
    } else {
      element.fail("expected <box>, <cylinder>, <sphere>, <capsule> or <mesh>");
    }
    return read;
  }

  fs::path mesh_file(const XmlElement& element) const {
    const std::string name = element.text("filename");
    const auto refuse = [&](const std::string& reason) {
      element.fail(fmt::format("filename: \"{}\" {}", base::shortened(name), reason));
    };
    const auto found_in = [&](const std::vector<fs::path>& places, const char* expected) {
      const auto found = std::ranges::find_if(places, is_file);
      if (found == places.end()) {
        std::string tried;
        for (const fs::path& place : places) tried += (tried.empty() ? "" : ", ") + place.string();
        refuse(fmt::format("is not there; tried {}. Expected {}", base::shortened(tried, 800),
                           expected));
      }
      return *found;
    };
    for (const std::string_view scheme : {"package://", "model://"}) {
      if (!name.starts_with(scheme)) continue;
      return found_in(package_places(name.substr(scheme.size())),
                      "the key packages with the folder of its package");
    }
    if (name.find("$(") != std::string::npos || name.find("${") != std::string::npos) {
      refuse("is to be expanded; expected an expanded file: `xacro FILE > robot.urdf`");
    }
    const std::string_view local = "file://";
    const bool is_local = name.starts_with(local);
    if (!is_local && name.find("://") != std::string::npos) {
      refuse("is no file; expected a path, file:// or package://");
    }
    return found_in({folder_ / (is_local ? name.substr(local.size()) : name)},
                    "a mesh, by a path from the robot's file");
  }

  std::vector<fs::path> package_places(const std::string& path) const {
    const std::string package = path.substr(0, path.find('/'));
    const std::string rest = path.substr(std::min(path.size(), package.size() + 1));
    std::vector<fs::path> places;
    const auto named = packages_.named.find(package);
    if (named != packages_.named.end()) return {named->second / rest};
    for (const fs::path& folder : packages_.folders) places.push_back(folder / package / rest);
    for (fs::path at = folder_;; at = at.parent_path()) {
      places.push_back(at / package / rest);
      if (at.filename() == package) places.push_back(at / rest);
      if (at == at.root_path() || at.empty()) break;
    }
    return places;
  }

  void read_joint(const XmlElement& element) {
    constexpr double pi = std::numbers::pi;
    Joint joint;
    joint.name = element.text("name");
    if (robot_.find_joint(joint.name)) {
      element.fail(
          fmt::format("\"{}\" is there twice; expected it once", base::shortened(joint.name)));
    }
    const std::string kind = element.text("type");
    constexpr std::pair<std::string_view, JointKind> kinds[] = {
        {"fixed", JointKind::fixed},
        {"revolute", JointKind::revolute},
        {"continuous", JointKind::continuous},
        {"prismatic", JointKind::prismatic}};
    const auto found =
        std::ranges::find(kinds, kind, [](const auto& known) { return known.first; });
    if (found == std::end(kinds)) {
      element.fail(fmt::format("type \"{}\"; expected fixed, revolute, continuous or prismatic",
                               base::shortened(kind)));
    }
    joint.kind = found->second;
    joint.parent = expect_named(robot_.links, element.required("parent"), "link", "link");
    joint.child = expect_named(robot_.links, element.required("child"), "link", "link");
    joint.origin = read_origin(element);
    if (joint.moves()) {
      if (const auto axis = element.child("axis")) {
        joint.axis = axis->vector("xyz");
        if (joint.axis.isZero(0)) axis->fail("xyz: found 0 0 0; expected a direction");
        joint.axis = base::unit(joint.axis);
      }
    }
    if (joint.kind == JointKind::continuous) {
      joint.lower = -pi;
      joint.upper = pi;
    } else if (joint.moves()) {
      const XmlElement limit = element.required("limit");
      // URDF takes 0 for both, so that the joint would stand still.
      if (!limit.has("lower") && !limit.has("upper") && !element.child("mimic")) {
        limit.fail("neither lower nor upper; expected the range of the joint");
      }
      joint.lower = limit.number("lower", 0.0);
      joint.upper = limit.number("upper", 0.0);
      if (joint.lower > joint.upper) {
        limit.fail(fmt::format("lower {} above upper {}; expected lower <= upper", joint.lower,
                               joint.upper));
      }
    }
    for (const Joint& other : robot_.joints) {
      if (other.child != joint.child) continue;
      element.fail(fmt::format("its child \"{}\" is that of \"{}\" too; expected a tree of links",
                               base::shortened(robot_.links[joint.child].name),
                               base::shortened(other.name)));
    }
    robot_.joints.push_back(std::move(joint));
  }

  // Joints may mimic those that come later.
  void read_mimic(const XmlElement& element) {
    const std::optional<XmlElement> mimic = element.child("mimic");
    if (!mimic) return;
    Joint& joint = robot_.joints[*robot_.find_joint(element.text("name"))];
    if (!joint.moves()) return;
    joint.mimic = {.joint = expect_named(robot_.joints, *mimic, "joint", "joint"),
                   .multiplier = mimic->number("multiplier", 1.0),
                   .offset = mimic->number("offset", 0.0)};
    if (!robot_.joints[joint.mimic->joint].moves()) {
      mimic->fail("joint: found one that is fixed; expected one that moves");
    }
    std::uint32_t at = *robot_.find_joint(joint.name);
    for (std::size_t steps = 0; robot_.joints[at].mimic; ++steps) {
      at = robot_.joints[at].mimic->joint;
      if (steps > robot_.joints.size()) {
        mimic->fail("joints mimic each other in a circle; expected one with a value of its own");
      }
    }
  }

  void order_joints(const XmlElement& root) {
    std::vector<char> reached(robot_.links.size(), 1);
    for (const Joint& joint : robot_.joints) reached[joint.child] = 0;
    std::vector<std::string> roots;
    for (std::size_t i = 0; i < reached.size(); ++i) {
      if (reached[i] != 0) roots.push_back(fmt::format("\"{}\"", robot_.links[i].name));
    }
    if (roots.size() != 1) {
      root.fail(roots.empty()
                    ? "every link is a child; expected a tree, with a link that is none"
                    : fmt::format("{} links are no joint's child: {}; expected one, the root",
                                  roots.size(),
                                  base::shortened(fmt::format("{}", fmt::join(roots, ", ")), 400)));
    }
    robot_.root = static_cast<std::uint32_t>(std::ranges::find(reached, char{1}) - reached.begin());
    // The new place of each joint, from which mimics follow.
    std::vector<std::uint32_t> order;
    std::vector<char> placed(robot_.joints.size(), 0);
    for (bool goes_on = true; goes_on;) {
      goes_on = false;
      for (std::uint32_t i = 0; i < robot_.joints.size(); ++i) {
        const Joint& joint = robot_.joints[i];
        if (placed[i] != 0 || reached[joint.parent] == 0) continue;
        order.push_back(i);
        placed[i] = reached[joint.child] = 1;
        goes_on = true;
      }
    }
    if (order.size() != robot_.joints.size()) {
      const auto& apart = robot_.joints[static_cast<std::size_t>(
          std::ranges::find(placed, char{0}) - placed.begin())];
      root.fail(fmt::format("the joint \"{}\" is part of a loop; expected a tree of links",
                            base::shortened(apart.name)));
    }
    std::vector<std::uint32_t> new_place(order.size());
    std::vector<Joint> joints;
    for (std::uint32_t i = 0; i < order.size(); ++i) new_place[order[i]] = i;
    for (const std::uint32_t old : order) joints.push_back(std::move(robot_.joints[old]));
    for (Joint& joint : joints) {
      if (joint.mimic) joint.mimic->joint = new_place[joint.mimic->joint];
    }
    robot_.joints = std::move(joints);
  }

  fs::path file_, folder_;
  const Packages& packages_;
  Robot robot_;
};

using LinkPairs = std::set<std::pair<std::uint32_t, std::uint32_t>>;

void add_pair(LinkPairs& pairs, std::uint32_t a, std::uint32_t b) {
  if (a != b) pairs.insert(std::minmax(a, b));
}

// Joined rigidly, or by one moving joint.
LinkPairs joined_pairs(const Robot& robot) {
  const std::size_t count = robot.links.size();
  std::vector<std::uint32_t> rigid(count);  // links that fixed joints join
  for (std::uint32_t i = 0; i < count; ++i) rigid[i] = i;
  for (const Joint& joint : robot.joints) {  // parents come first
    if (!joint.moves()) rigid[joint.child] = rigid[joint.parent];
  }
  std::vector<std::vector<std::uint32_t>> members(count), beside(count);
  std::vector<char> has_shapes(count, 0);
  for (std::uint32_t i = 0; i < count; ++i) {
    members[rigid[i]].push_back(i);
    if (!robot.links[i].shapes.empty()) has_shapes[rigid[i]] = 1;
  }
  for (const Joint& joint : robot.joints) {
    const std::uint32_t a = rigid[joint.parent], b = rigid[joint.child];
    if (a == b) continue;
    beside[a].push_back(b);
    beside[b].push_back(a);
  }
  LinkPairs pairs;
  const auto join = [&](std::uint32_t a, std::uint32_t b) {
    for (const std::uint32_t i : members[a]) {
      for (const std::uint32_t k : members[b]) add_pair(pairs, i, k);
    }
  };
  for (std::uint32_t first = 0; first < count; ++first) {
    join(first, first);
    std::vector<char> seen(count, 0);
    seen[first] = 1;
    std::vector<std::uint32_t> open = {first};
    while (!open.empty()) {
      const std::uint32_t at = open.back();
      open.pop_back();
      for (const std::uint32_t next : beside[at]) {
        if (std::exchange(seen[next], char{1}) != 0) continue;
        join(first, next);
        if (has_shapes[next] == 0) open.push_back(next);
      }
    }
  }
  return pairs;
}

// Warns of what SRDF does not know, and of a file of another robot.
void check_srdf(const XmlElement& root, const Robot& robot) {
  constexpr std::string_view known[] = {"disable_collisions",
                                        "disable_default_collisions",
                                        "enable_collisions",
                                        "end_effector",
                                        "group",
                                        "group_state",
                                        "joint_property",
                                        "link_sphere_approximation",
                                        "passive_joint",
                                        "virtual_joint"};
  expect_expanded(root);
  if (root.has("name") && root.text("name") != robot.name) {
    root.warn(fmt::format("of the robot \"{}\"; expected \"{}\", as in the URDF file",
                          base::shortened(root.text("name")), base::shortened(robot.name)));
  }
  for (const XmlElement& element : root.children()) {
    const std::string name = element.name();
    if (name == "link" || name == "joint") element.fail("of URDF; expected SRDF");
    if (std::ranges::find(known, name) == std::end(known)) {
      element.warn("is left out: " + base::unknown_name("element of SRDF", name, known));
    }
  }
}

// Returns the pairs that are disabled.
LinkPairs read_srdf(const fs::path& file, Robot& robot) {
  const XmlFile xml(file, "robot");
  const XmlElement root = xml.root();
  check_srdf(root, robot);
  LinkPairs pairs;
  // Files name links that a robot's variant does not have.
  const auto link = [&](const XmlElement& element, const char* attribute) {
    const std::string name = element.text(attribute);
    const auto found = robot.find_link(name);
    const bool is_new =
        !found && std::ranges::find(robot.unknown_links, name) == robot.unknown_links.end();
    if (is_new) robot.unknown_links.push_back(name);
    return found;
  };
  const auto both = [&](const XmlElement& element, const auto& use) {
    const auto first = link(element, "link1"), second = link(element, "link2");
    if (first && second) use(*first, *second);
  };
  for (const XmlElement& element : root.children("disable_default_collisions")) {
    const auto of = link(element, "link");
    for (std::uint32_t other = 0; of && other < robot.links.size(); ++other) {
      add_pair(pairs, *of, other);
    }
  }
  for (const XmlElement& element : root.children("enable_collisions")) {
    both(element, [&](std::uint32_t a, std::uint32_t b) { pairs.erase(std::minmax(a, b)); });
  }
  for (const XmlElement& element : root.children("disable_collisions")) {
    both(element, [&](std::uint32_t a, std::uint32_t b) { add_pair(pairs, a, b); });
  }
  for (const XmlElement& state : root.children("group_state")) {
    std::map<std::string, double>& values = robot.states[state.text("name")];
    for (const XmlElement& joint : state.children("joint")) {
      // Virtual joints have several values, and a variant of the robot may lack some joints.
      const auto known = robot.find_joint(joint.text("name"));
      if (known && robot.joints[*known].moves()) {
        values[joint.text("name")] = joint.number("value");
      }
    }
  }
  robot.files.push_back(file);
  return pairs;
}

}  // namespace

std::optional<std::uint32_t> Robot::find_link(std::string_view link) const {
  return find_named(links, link);
}

std::optional<std::uint32_t> Robot::find_joint(std::string_view joint) const {
  return find_named(joints, joint);
}

Robot read_robot(const fs::path& urdf, const fs::path& srdf, const Packages& packages) {
  Robot robot = UrdfReader(urdf, packages).read();
  const LinkPairs joined = joined_pairs(robot);
  LinkPairs disabled;
  fs::path beside = urdf;
  beside.replace_extension(".srdf");
  if (!srdf.empty()) {
    disabled = read_srdf(srdf, robot);
  } else if (is_file(beside)) {
    disabled = read_srdf(beside, robot);
  }
  for (const auto& [a, b] : joined) robot.joined.push_back({a, b});
  for (const auto& pair : disabled) {
    if (!joined.contains(pair)) robot.disabled.push_back({pair.first, pair.second});
  }
  return robot;
}

}  // namespace touchstone::scene
