// Places a robot's links.
#include "harness/base/reproducible_math.h"
#include "harness/scene/robot/robot.h"

namespace touchstone::scene {
namespace {

Pose motion_of(const Joint& joint, double value) {
  switch (joint.kind) {
    case JointKind::fixed: break;
    case JointKind::revolute:
    case JointKind::continuous: return {base::rotation_over(joint.axis, value), Vec3d::Zero()};
    case JointKind::prismatic: return {Mat3d::Identity(), value * joint.axis};
  }
  return {};
}

}  // namespace

std::vector<double> usual_values(const Robot& robot) {
  std::vector<double> values;
  for (const Joint& joint : robot.joints) {
    const bool holds_zero = joint.lower <= 0 && joint.upper >= 0;
    values.push_back(holds_zero ? 0 : 0.5 * joint.lower + 0.5 * joint.upper);
  }
  follow_mimics(robot, values);
  return values;
}

void follow_mimics(const Robot& robot, std::span<double> values, std::span<const char> given) {
  const auto follows = [&](std::size_t joint) {
    return robot.joints[joint].mimic && (given.empty() || given[joint] == 0);
  };
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    // A joint may mimic one that mimics another; a chain ends, as the reader has seen.
    double factor = 1, sum = 0;
    std::size_t at = i;
    while (follows(at)) {
      const Mimic& mimic = *robot.joints[at].mimic;
      sum += factor * mimic.offset;
      factor *= mimic.multiplier;
      at = mimic.joint;
    }
    if (at != i) values[i] = factor * values[at] + sum;
  }
}

std::vector<Pose> link_poses(const Robot& robot, std::span<const double> values, const Pose& base) {
  std::vector<Pose> poses(robot.links.size());
  poses[robot.root] = base;
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    const Joint& joint = robot.joints[i];
    poses[joint.child] =
        base::placed(base::placed(poses[joint.parent], joint.origin), motion_of(joint, values[i]));
  }
  return poses;
}

}  // namespace touchstone::scene
