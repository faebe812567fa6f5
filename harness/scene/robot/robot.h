// A robot: links with shapes, joined by joints, as URDF and SRDF describe it; and where its links are.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "algorithms/core/pair_sink.h"
#include "algorithms/core/pose.h"
#include "algorithms/core/shape.h"

namespace touchstone::scene {

// What a link collides with: a shape, or the mesh of a file.
struct LinkShape {
  Shape shape;  // sphere, box, cylinder or capsule (along z); without a meaning if there is a mesh
  std::filesystem::path mesh;   // empty: none
  Vec3d scale = Vec3d::Ones();  // of the mesh, along its axes
  Pose pose;                    // in the link's frame, metres
  std::int64_t line = 0;        // of the file
};

struct Link {
  std::string name;
  std::vector<LinkShape> shapes;
};

enum class JointKind : std::uint8_t {
  fixed,
  revolute,    // turns about its axis between limits
  continuous,  // turns without limits
  prismatic,   // slides along its axis between limits
};

// The joint's value is that of another one: multiplier * value + offset.
struct Mimic {
  std::uint32_t joint = 0;
  double multiplier = 1, offset = 0;
};

struct Joint {
  std::string name;
  JointKind kind = JointKind::fixed;
  std::uint32_t parent = 0, child = 0;  // links
  Pose origin;                          // in the parent's frame, at value 0
  Vec3d axis = Vec3d::UnitX();          // of unit length, in the joint's frame
  double lower = 0, upper = 0;          // radians or metres; of `continuous` -pi and pi
  std::optional<Mimic> mimic;

  bool moves() const { return kind != JointKind::fixed; }
  // Whether it has a value of its own.
  bool is_free() const { return moves() && !mimic; }
};

struct Robot {
  std::string name;
  std::vector<Link> links;    // as in the file
  std::vector<Joint> joints;  // each behind the one that moves its parent
  std::uint32_t root = 0;     // the link that no joint moves
  // Pairs of links that are not to be asked, sorted, a < b. `joined` has those that are joined rigidly, and those that a
  // moving joint joins, directly or through links without shapes; `disabled` has others that SRDF disables.
  std::vector<IndexPair> joined, disabled;
  // The links that SRDF names and the robot does not have: what it says of them is left out.
  std::vector<std::string> unknown_links;
  // SRDF's group states: values by joint. States that several groups have by one name are one.
  std::map<std::string, std::map<std::string, double>> states;
  std::vector<std::filesystem::path> files;  // that were read: URDF and SRDF

  // Nothing if there is none of this name.
  std::optional<std::uint32_t> find_link(std::string_view link) const;
  std::optional<std::uint32_t> find_joint(std::string_view joint) const;
};

// Where `package://NAME/REST` is looked for.
struct Packages {
  std::map<std::string, std::filesystem::path> named;  // the folder of a package
  std::vector<std::filesystem::path> folders;          // in which packages are
};

// Reads a URDF file (wiki.ros.org/urdf/XML): links' collision elements (box, cylinder, sphere, capsule, mesh with
// scale; several a link), and joints of the kinds above with limits and mimics. What is not of use for collisions is
// ignored (visual, inertial, transmission...). A package that `packages` does not have is a folder of its name beside the
// URDF file, or above. Reads of an SRDF file (wiki.ros.org/srdf) which collisions it disables, and group states. An
// empty `srdf` is the file of that ending beside the URDF file, if there is one.
// Warns of elements that SRDF does not have, and of an SRDF file of another robot. Throws InputError with file, line and
// what was expected: also for joints that are floating or planar, lack a range, make a loop or leave a link alone; for
// names that are there twice or that nothing has; for macros of xacro; and for meshes that are missing or of a format
// that is not read.
Robot read_robot(const std::filesystem::path& urdf, const std::filesystem::path& srdf = {},
                 const Packages& packages = {});

// The value of each joint where nothing says otherwise, as MoveIt has it: 0, or the middle of the limits where these
// exclude 0.
std::vector<double> usual_values(const Robot& robot);
// Gives the joints that mimic others the values of those, but for joints that are `given` (one a joint; empty: none).
void follow_mimics(const Robot& robot, std::span<double> values, std::span<const char> given = {});
// Poses of the links, by forward kinematics in double, for values of all joints (radians, metres; of fixed ones
// without a meaning), with the root at `base`. The same bits on every platform.
std::vector<Pose> link_poses(const Robot& robot, std::span<const double> values, const Pose& base);

}  // namespace touchstone::scene
