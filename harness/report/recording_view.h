// A scene, played for the page.
#pragma once

#include <filesystem>
#include <tuple>
#include <vector>

#include "algorithms/registry.h"
#include "harness/files/json_line.h"
#include "harness/scene/scene.h"

namespace touchstone::report {

struct RecordingRequest {
  std::filesystem::path scene;
  std::filesystem::path page = {};  // will be written, so must be none of the scene's files
  scene::SceneOverrides overrides = {};
  int most_frames = 240;
  // Their verdicts colour the bodies; in double where they can.
  std::vector<const NarrowPhaseEntry*> narrow;
  // The structures of these are shown, if they have one to show.
  std::vector<const BroadPhaseEntry*> broad;
  double time_limit = 5;  // seconds a frame's queries of an algorithm may take

  // Returns what tells one scene from another.
  auto key() const {
    return std::tuple(scene, overrides.count, overrides.seed, overrides.frames, overrides.gap);
  }
};

// Plays the scene: poses, boxes, the pairs whose boxes overlap (or that the scene lists) with every
// algorithm's verdict, and the distance of each, which `certified` proves. A recording of boxes
// alone has no bodies, and so no verdicts.
files::OrderedJson recording_view(const RecordingRequest& request);

}  // namespace touchstone::report
