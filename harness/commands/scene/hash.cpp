// touchstone scene hash: prints the hash of a scene.
#include <fmt/core.h>

#include <memory>
#include <string>

#include "harness/commands/arguments.h"
#include "harness/commands/commands.h"
#include "harness/commands/shared_options.h"
#include "harness/scene/scene.h"

namespace touchstone::commands {
namespace {

struct HashOptions {
  std::string scene;
  scene::SceneOverrides overrides;
};

}  // namespace

void add_scene_hash(Arguments command) {
  auto options = std::make_shared<HashOptions>();
  command.text("scene", options->scene, "Scene file: .toml, rigid-ipc's .json, or .aabbs")
      .required();
  command.number("--frames", options->overrides.frames, "Instead of the scene's own")
      .within(1, 1'000'000);
  add_scene_overrides(command, options->overrides);
  command.job([options] {
    fmt::print("{}\n", scene::scene_hash(scene::load_scene(options->scene, options->overrides)));
    return exit_done;
  });
}

}  // namespace touchstone::commands
