// The steps of a scene as motions: where bodies are in a frame, and how they get to the next.
#pragma once

#include <filesystem>
#include <vector>

#include "algorithms/core/motion.h"
#include "algorithms/core/pose.h"
#include "harness/scene/scene.h"

namespace touchstone::scene {

// A body of the scene has the same index in both lists.
struct MotionStep {
  std::vector<Pose> poses;  // in the frame
  std::vector<touchstone::Motion> motions;
};

// Returns a step for each frame, from it to the next: as many steps as the scene has frames. In a
// step a body goes straight to its place in the next frame, also where that is on a curve or behind a
// wall's reflection, and turns evenly by its angular velocity. Throws InputError with the name of the
// file if the scene has no bodies, or if they jump, arrive or leave.
std::vector<MotionStep> motion_steps(const Scene& scene, const std::filesystem::path& file);

}  // namespace touchstone::scene
