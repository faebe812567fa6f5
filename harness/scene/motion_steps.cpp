// Steps of a scene, from its kinematics.
#include "harness/scene/motion_steps.h"

#include "harness/base/error.h"
#include "harness/scene/kinematics.h"

namespace touchstone::scene {

std::vector<MotionStep> motion_steps(const Scene& scene, const std::filesystem::path& file) {
  if (!scene.recording.empty() || !scene.pairs.empty()) {
    throw base::InputError(file.string(), 0,
                           "has boxes or pairs alone; expected bodies that move in a step");
  }
  if (scene.motion.teleports > 0 || scene.motion.churn > 0) {
    throw base::InputError(file.string(), 0,
                           "has bodies that jump, arrive or leave; expected bodies that move");
  }
  std::vector<MotionStep> steps;
  Kinematics kinematics(scene);
  for (int frame = 0; frame < scene.frames; ++frame) {
    MotionStep& step = steps.emplace_back();
    step.poses.assign(kinematics.poses().begin(), kinematics.poses().end());
    step.motions.resize(step.poses.size());
    kinematics.next();
    for (std::size_t i = 0; i < step.motions.size(); ++i) {
      const Body& body = scene.bodies[i];
      if (!body.moving) continue;
      step.motions[i].displacement = kinematics.poses()[i].translation - step.poses[i].translation;
      step.motions[i].rotation_vector = scene.motion.time_step * body.angular_velocity;
    }
  }
  return steps;
}

}  // namespace touchstone::scene
