// Plays a scene once and keeps the poses of its frames.
#include "harness/trade/pipeline/scene_frames.h"

#include <algorithm>

#include "harness/base/error.h"
#include "harness/scene/player.h"
#include "harness/trade/configuration.h"

namespace touchstone::trade {
namespace {

constexpr std::size_t most_bytes = std::size_t{256} << 20;

bool same(const Pose& a, const Pose& b) {
  return a.rotation == b.rotation && a.translation == b.translation;
}

}  // namespace

SceneFrames::SceneFrames(const scene::Scene& from, int most_frames)
    : scene(&from), mesh_of(from.shapes.size(), nullptr), moves(from.bodies.size(), 0) {
  for (std::size_t i = 0; i < mesh_of.size(); ++i) mesh_of[i] = from.mesh_of(i);
  if (!from.recording.empty()) {
    throw base::InputError(from.name + " is a recording of boxes; expected a scene with bodies");
  }
  const std::size_t fit = most_bytes / (from.bodies.size() * sizeof(Pose));
  const std::size_t most = std::clamp(fit, std::size_t{2}, static_cast<std::size_t>(most_frames));
  scene::ScenePlayer player(from, scene::BoxKind::tight);
  do {
    SceneFrame& frame = frames.emplace_back();
    frame.poses.assign(player.poses().begin(), player.poses().end());
    frame.present.assign(from.bodies.size(), 0);
    for (std::uint32_t i = 0; i < player.boxes().size(); ++i) {
      frame.present[i] = player.boxes()[i].is_empty() ? 0 : 1;
      if (frame.present[i] != 0 && from.shapes[from.bodies[i].shape].kind == ShapeKind::halfspace) {
        frame.halfspaces.emplace_back(i, player.boxes()[i]);
      }
    }
  } while (frames.size() < most && player.next());
  for (std::uint32_t i = 0; i < moves.size(); ++i) {
    const bool still = std::ranges::all_of(frames, [&](const SceneFrame& frame) {
      return same(frame.poses[i], frames[0].poses[i]) && frame.present[i] == frames[0].present[i];
    });
    if (still) continue;
    moves[i] = 1;
    movers.push_back(i);
  }
  if (movers.empty()) frames.resize(1);
}

std::size_t SceneFrames::kind_of(std::size_t body) const {
  const std::uint32_t shape = scene->bodies[body].shape;
  return mesh_of[shape] != nullptr ? mesh_body
                                   : static_cast<std::size_t>(scene->shapes[shape].kind);
}

}  // namespace touchstone::trade
