// Planning scenes of MoveIt, as its benchmark sets have them.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "algorithms/core/pose.h"
#include "algorithms/core/shape.h"
#include "harness/geometry/mesh.h"

namespace touchstone::scene {

struct Obstacle {
  std::string name;  // the object's id; several shapes may have the same
  Shape shape;       // without a meaning if there is a mesh
  std::optional<geometry::Mesh> mesh;
  std::string frame;  // of the pose: "world", or a link
  Pose pose;
  std::int64_t line = 0;
};

struct PlanningScene {
  std::vector<Obstacle> obstacles;
  // Names of links or obstacles that may touch, from the matrix of allowed collisions.
  std::vector<std::pair<std::string, std::string>> allowed;
  std::map<std::string, double> joints;  // values of the robot's state
  Pose base;                             // of the robot, from its multi_dof_joint_state
};

// Whether the file is YAML by its ending.
bool is_yaml(const std::filesystem::path& file);

// Reads a planning scene (moveit_msgs/PlanningScene as YAML): the objects of `world` with primitives (box, sphere,
// cylinder, cone) and meshes, `allowed_collision_matrix`, and where the robot stands. Positions and quaternions (x, y, z,
// w) are lists or maps. Throws InputError with file and line: also for a file with none of these, and for what it
// does not take, which is planes, attached objects, octomaps, padding, scaling, and collisions that are allowed by
// default.
PlanningScene read_planning_scene(const std::filesystem::path& file);

}  // namespace touchstone::scene
