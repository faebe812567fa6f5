// Scenes that a test writes as text.
#pragma once

#include <string>

#include "harness/scene/scene.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {

inline scene::Scene load_text(const std::string& content) {
  const TemporaryFolder folder;
  return scene::load_scene(folder.write("scene.toml", content));
}

}  // namespace touchstone
