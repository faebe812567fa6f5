// A scene as a pipeline plays it: the poses of its frames, all at once.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "algorithms/core/aabb.h"
#include "algorithms/core/pose.h"
#include "harness/geometry/mesh.h"
#include "harness/scene/scene.h"

namespace touchstone::trade {

struct SceneFrame {
  std::vector<Pose> poses;    // of every body
  std::vector<char> present;  // of every body
  // Half-spaces have no box of their own: theirs are cut to where the scene happens.
  std::vector<std::pair<std::uint32_t, Aabb>> halfspaces;
};

struct SceneFrames {
  // The scene outlives it. Of a long scene so many frames from the first on; of one in which
  // nothing moves, one. InputError for a recording, which has no bodies.
  SceneFrames(const scene::Scene& scene, int most_frames);

  // A scene of one frame: nothing moves, nobody is asked twice.
  bool is_static() const { return frames.size() == 1; }
  // Index into configuration.h's kinds of bodies.
  std::size_t kind_of(std::size_t body) const;

  const scene::Scene* scene;
  // The mesh of each of the scene's shapes, or null. As a solid, the mesh is the body.
  std::vector<const geometry::Mesh*> mesh_of;
  std::vector<SceneFrame> frames;
  std::vector<char> moves;  // of each body: its pose changes, or it comes and goes
  std::vector<std::uint32_t> movers;
};

}  // namespace touchstone::trade
