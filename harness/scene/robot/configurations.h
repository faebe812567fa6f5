// Configurations of a robot, one a frame: from files, along straight paths, or at random.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "harness/scene/robot/robot.h"

namespace touchstone::scene {

// Values of all joints of a robot (radians, metres), in the order of its joints.
using Configuration = std::vector<double>;

// What joints are where nothing else is said, and which of them have these values for good: a joint that mimics another
// follows it unless it is `given`.
struct UsualConfiguration {
  Configuration values;
  std::vector<char> given;  // one a joint
};

// usual_values with others for some joints. Throws std::out_of_range for a joint that the robot does not have.
UsualConfiguration usual_configuration(const Robot& robot,
                                       const std::map<std::string, double>& values);
// The same with further values.
Configuration with_values(const Robot& robot, const UsualConfiguration& usual,
                          const std::map<std::string, double>& values);

struct TimedConfigurations {
  std::vector<Configuration> frames;
  double time_step = 0;  // seconds: the mean of the column `time`; 0 without it
};

// Reads a CSV file with a column a joint (radians, metres), named as the joint, and often a column `time` (seconds,
// rising). A row is a frame. Joints without a column have their usual value, or follow those that they mimic. Warns of
// values that are more than 1e-6 outside of the limits of a joint. Throws InputError with file and line, also for a
// column that is no joint which moves.
TimedConfigurations read_configurations(const std::filesystem::path& file, const Robot& robot,
                                        const UsualConfiguration& usual);

// A problem of motion planning, as the benchmark sets of MoveIt have it.
struct MotionRequest {
  std::map<std::string, double> start, goal;  // by joint
};
// Reads `start_state` and the joint constraints of the first of `goal_constraints` from YAML. Throws InputError with
// file and line.
MotionRequest read_request(const std::filesystem::path& file, const Robot& robot);

// From one configuration to another in equal steps, both included: steps + 1 configurations. A continuous joint turns
// the shorter way.
std::vector<Configuration> straight_path(const Robot& robot, const Configuration& from,
                                         const Configuration& to, std::size_t steps);

// Which joints random configurations move: one a joint of the robot. Joints that mimic others follow.
struct RandomConfigurations {
  std::size_t count = 0;
  std::uint64_t seed = 1;
  std::vector<char> moves;
  // 0: each is drawn anew, evenly within the limits. Otherwise each is the one before, with each joint moved by at most
  // this part of its range, and reflected at the limits (a continuous one goes round); the first one is the usual one,
  // which is within the limits.
  double step = 0;
};
std::vector<Configuration> random_configurations(const Robot& robot,
                                                 const UsualConfiguration& usual,
                                                 const RandomConfigurations& request);

}  // namespace touchstone::scene
