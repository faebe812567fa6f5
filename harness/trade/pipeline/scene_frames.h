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
  std::vector<Pose> poses;    // one for every body
  std::vector<char> present;  // one for every body
  // Half-spaces have no box of their own: theirs are cut to the extent of the scene.
  std::vector<std::pair<std::uint32_t, Aabb>> halfspaces;
};

struct SceneFrames {
  // The scene outlives it. It keeps the first `most_frames` frames of a long scene, and one frame
  // of a scene in which nothing moves. Throws InputError for a recording, which has no bodies.
  SceneFrames(const scene::Scene& scene, int most_frames);

  // Returns true for a scene of one frame, in which each pair is solved once.
  bool is_static() const { return frames.size() == 1; }
  // An index into configuration.h's kinds of bodies.
  std::size_t kind_of(std::size_t body) const;

  const scene::Scene* scene;
  // The mesh of each of the scene's shapes, or null. The mesh, as a solid, is the body.
  std::vector<const geometry::Mesh*> mesh_of;
  std::vector<SceneFrame> frames;
  std::vector<char> moves;  // for each body: true if its pose changes, or it comes and goes
  std::vector<std::uint32_t> movers;
};

}  // namespace touchstone::trade
