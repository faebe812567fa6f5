// Bodies of a scene that fall and collide, by Bullet's dynamics.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "harness/scene/pose_log.h"
#include "harness/scene/scene.h"

namespace touchstone::simulate {

struct Settings {
  double seconds = 5;  // how long bodies fall
  double from = 0;     // seconds that are simulated, and left out of the frames
  double fps = 60;     // frames a second
  // Metres per second squared, along -z. Without it gravity is the acceleration of a scene whose motion is
  // free_fall or rotating_gravity (which turns), and else 9.81.
  std::optional<double> gravity = {};
};

// Empty if Bullet's dynamics are built; else why not.
std::string lacking();

// Gets the bodies that moved since the frame before, and one that rests if none did; in frame 0 all that may move.
using Sink = std::function<void(int frame, std::span<const scene::LoggedPose> moved)>;

struct Simulated {
  int frames = 0;           // frame 0 included
  std::size_t free = 0;     // bodies that may move
  std::size_t resting = 0;  // of these, those that did not move between the last two frames
};

// Simulates bodies of 1,000 kg per cubic metre in steps of 1/120 s or a little less, single-threaded: the same
// scene gives the same bits again on one machine. Bodies with `moving = false` stay. Pairs that the scene ignores pass
// through each other. Walls of the scene are planes. Meshes that stay are trees of triangles, those that
// move GImpact's surfaces.
//
// Throws InputError, with the name of the file, if Bullet is not built, no body may move, a body that may move has no
// volume or is a half-space, bodies have tracks, jump, arrive, leave or come in pairs, or a pose becomes infinite.
Simulated simulate(const scene::Scene& scene, const std::filesystem::path& file,
                   const Settings& settings, const Sink& sink);

}  // namespace touchstone::simulate
