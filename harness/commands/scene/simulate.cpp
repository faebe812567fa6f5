// touchstone scene simulate: lets the bodies of a scene fall and collide, and writes where they are.
#include "harness/simulate/simulate.h"

#include <fmt/core.h>
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "harness/base/error.h"
#include "harness/commands/arguments.h"
#include "harness/commands/commands.h"
#include "harness/files/text_file.h"
#include "harness/files/toml_table.h"
#include "harness/scene/pose_log.h"
#include "harness/scene/scene.h"

namespace touchstone::commands {
namespace {

constexpr double most_simulated_frames = 1'000'000;  // that a scene may have

struct SimulateOptions {
  std::string scene, out;
  simulate::Settings settings;
};

std::string log_scene_text(const SimulateOptions& options) {
  std::ostringstream text;
  text << "# Written by `touchstone scene simulate`: these bodies, where Bullet's dynamics moved "
          "them.\n"
       << toml::table{{"import", std::filesystem::absolute(options.scene).string()},
                      {"poses", std::filesystem::path(options.out).filename().string()},
                      {"time_step", 1 / options.settings.fps}}
       << "\n";
  return text.str();
}

void simulate_scene(const SimulateOptions& options) {
  const std::filesystem::path out = options.out;
  const simulate::Settings& settings = options.settings;
  if (out.extension() != ".csv") {
    throw base::InputError("--out: found " + options.out + "; expected a name ending in .csv");
  }
  if (!(settings.from < settings.seconds)) {
    throw base::InputError(fmt::format("--from: found {}; expected less than the {} of --seconds",
                                       settings.from, settings.seconds));
  }
  if (settings.seconds * settings.fps >= most_simulated_frames) {
    throw base::InputError(
        fmt::format("--seconds: found {}, which is {:.0f} frames; expected less "
                    "than {:.0f}",
                    settings.seconds, settings.seconds * settings.fps, most_simulated_frames));
  }
  if (const std::string lacking = simulate::lacking(); !lacking.empty()) {
    throw base::InputError("bodies cannot fall: " + lacking);
  }
  const scene::Scene scene = scene::load_scene(options.scene);
  std::filesystem::path beside = out;
  beside.replace_extension(".toml");
  files::check_outputs(scene.inputs(),
                       std::vector<files::NamedFile>{{"--out", out}, {"--out", beside}});
  scene::PoseLogWriter log(out);
  const simulate::Simulated done = simulate::simulate(
      scene, options.scene, settings,
      [&](int frame, std::span<const scene::LoggedPose> moved) { log.add(frame, moved); });
  log.close();
  files::write_text(beside, log_scene_text(options));
  fmt::print("{}: {} of {} bodies fell, {} frames; {} did not move in the last one\n", options.out,
             done.free, scene.bodies.size(), done.frames, done.resting);
  fmt::print("To measure on it: touchstone run --scene {}\n", beside.string());
}

}  // namespace

void add_scene_simulate(Arguments command) {
  const auto options = std::make_shared<SimulateOptions>();
  command.text("SCENE", options->scene, "Scene file: .toml or .json (rigid-ipc)")
      .required()
      .is_read();
  command
      .text("--out", options->out,
            "The poses (CSV), as a scene's `poses` reads them; the scene is written beside it, as "
            ".toml")
      .required();
  command.number("--seconds", options->settings.seconds, "How long bodies fall")
      .positive()
      .show_default();
  command.number("--from", options->settings.from, "Seconds at the start that are left out")
      .not_negative();
  command.number("--fps", options->settings.fps, "Frames a second")
      .within_real(1, 100'000)
      .show_default();
  command
      .number("--gravity", options->settings.gravity,
              "Metres a second squared, downwards; without it the scene's acceleration, or 9.81")
      .not_negative();
  command.footer(
      "Bodies with moving = false stay. Velocities are those of the scene. The same scene gives "
      "the same bits again "
      "on this machine.");
  command.job([options] {
    simulate_scene(*options);
    return exit_done;
  });
}

}  // namespace touchstone::commands
