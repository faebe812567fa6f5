// touchstone scene record: writes the boxes of a scene, frame by frame, for other programs.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>

#include "harness/base/error.h"
#include "harness/commands/arguments.h"
#include "harness/commands/commands.h"
#include "harness/commands/shared_options.h"
#include "harness/files/csv.h"
#include "harness/scene/box_frames.h"
#include "harness/scene/player.h"
#include "harness/scene/pose_log.h"
#include "harness/scene/scene.h"

namespace touchstone::commands {
namespace {

struct RecordOptions {
  std::string scene, out;
  scene::BoxKind boxes = scene::BoxKind::tight;
  bool poses = false;
  scene::SceneOverrides overrides;
};

void record_csv(scene::ScenePlayer& player, const std::filesystem::path& file) {
  files::CsvWriter csv(file, {"frame", "id", "min_x", "min_y", "min_z", "max_x", "max_y", "max_z"});
  do {
    const auto boxes = player.boxes();
    for (std::size_t id = 0; id < boxes.size(); ++id) {
      csv.field(player.frame()).field(id);
      scene::append_box(csv, boxes[id]);
      csv.end_row();
    }
  } while (player.next());
  csv.close();
}

// Broadmark's file also has a box of the world. Ours encloses all boxes of all frames.
void record_aabbs(scene::ScenePlayer& player, const std::string& name,
                  const std::filesystem::path& file) {
  scene::BoxRecording recording;
  recording.scene = name;
  recording.type = "touchstone";
  recording.world = player.boxes().front();
  do {
    const auto boxes = player.boxes();
    recording.frames.emplace_back(boxes.begin(), boxes.end());
    for (const Aabb& box : boxes) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        recording.world.min[axis] = std::min(recording.world.min[axis], box.min[axis]);
        recording.world.max[axis] = std::max(recording.world.max[axis], box.max[axis]);
      }
    }
  } while (player.next());
  scene::write_aabbs(recording, file);
}

void record(const RecordOptions& options) {
  const std::filesystem::path out = options.out;
  const bool csv = out.extension() == ".csv";
  if (!csv && out.extension() != ".aabbs") {
    throw base::InputError("--out: found " + options.out +
                           "; expected a name ending in .aabbs or .csv");
  }
  const scene::Scene scene = scene::load_scene(options.scene, options.overrides);
  files::check_outputs(scene.inputs(), std::vector<files::NamedFile>{{"--out", options.out}});
  if ((!csv || options.poses) && scene.motion.churn > 0) {
    throw base::InputError(
        options.scene, 0,
        options.poses ? "bodies come and go in this scene; expected bodies that stay for --poses"
                      : "bodies come and go in this scene, and Broadmark's format has the same "
                        "ones in every frame; expected --out with a name ending in .csv");
  }
  if (options.poses) {
    if (options.boxes != scene::BoxKind::tight) {
      throw base::InputError("--boxes: given beside --poses; expected one of the two");
    }
    if (!csv || !scene.recording.empty()) {
      throw base::InputError(
          "--poses: expected a scene with bodies, and --out with a name ending in .csv");
    }
    const int frames = scene::write_pose_log(scene, out);
    fmt::print("{}: scene {} ({}), {} bodies, {} frames\n", options.out, scene.name,
               scene::scene_hash(scene), scene.size(), frames);
    return;
  }
  scene::ScenePlayer player(scene, options.boxes);
  const std::size_t count = player.boxes().size();
  if (csv) {
    record_csv(player, out);
  } else {
    record_aabbs(player, scene.name, out);
  }
  fmt::print("{}: scene {} ({}), {} boxes, {} frames\n", options.out, scene.name,
             scene::scene_hash(scene), count, player.frame() + 1);
}

}  // namespace

void add_scene_record(Arguments command) {
  const auto options = std::make_shared<RecordOptions>();
  command
      .text("SCENE", options->scene,
            "Scene file: .toml, .json (rigid-ipc), .urdf, .aabbs or a model")
      .is_read()
      .required();
  command
      .text("--out", options->out,
            "The file to write: .aabbs (Broadmark's format) or .csv, as `pairs` reads them")
      .required();
  command.number("--frames", options->overrides.frames, "Instead of the scene's own")
      .within(1, 1'000'000);
  add_scene_overrides(command, options->overrides);
  command
      .one_of("--boxes", options->boxes, box_choices(),
              "Tight boxes, or loose ones that hold any attitude")
      .show_default("tight");
  command.flag("--poses", options->poses,
               "The poses of the bodies in place of their boxes, as a scene's `poses` reads them");
  command.job([options] {
    record(*options);
    return exit_done;
  });
}

}  // namespace touchstone::commands
