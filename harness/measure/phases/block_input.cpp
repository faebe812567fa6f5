// Plays a block's scene and finds its true pairs.
#include "harness/measure/phases/block_input.h"

#include <map>
#include <utility>

#include "harness/measure/phases/overlapping_pairs.h"
#include "harness/scene/player.h"

namespace touchstone::measure {

BlockInput::BlockInput(const scene::Scene& scene, scene::BoxKind kind, bool with_poses)
    : shapes(scene.shapes) {
  for (const scene::Body& body : scene.bodies) shape_of.push_back(body.shape);
  const bool listed = !scene.pairs.empty();
  scene::ScenePlayer player(scene, kind);
  do {
    BlockFrame& frame = frames.emplace_back();
    frame.boxes.assign(player.boxes().begin(), player.boxes().end());
    const FrameChange change = player.change();
    frame.moved.assign(change.moved.begin(), change.moved.end());
    frame.inserted.assign(change.inserted.begin(), change.inserted.end());
    frame.removed.assign(change.removed.begin(), change.removed.end());
    if (with_poses) frame.poses.assign(player.poses().begin(), player.poses().end());
    frame.truth = listed ? scene.pairs : overlapping_pairs(frame.boxes);
  } while (player.next());
}

std::string NarrowSet::kind_name() const { return grade::PairGroup{kind_a, kind_b, {}, {}}.name(); }

std::size_t NarrowSet::pairs() const {
  std::size_t total = 0;
  for (const grade::PairGroup& group : frames) total += group.size();
  return total;
}

std::vector<NarrowSet> narrow_sets(const BlockInput& input, const std::string& broad,
                                   std::span<const std::vector<IndexPair>> pairs,
                                   std::span<const Task> tasks) {
  std::map<std::pair<ShapeKind, ShapeKind>, std::vector<grade::PairGroup>> kinds;
  for (std::size_t frame = 0; frame < pairs.size(); ++frame) {
    for (grade::PairGroup& group :
         grade::group_by_kind(pairs[frame], input.shapes, input.shape_of)) {
      std::vector<grade::PairGroup>& frames = kinds[{group.kind_a, group.kind_b}];
      if (frames.empty()) {
        frames.assign(pairs.size(), grade::PairGroup{group.kind_a, group.kind_b, {}, {}});
      }
      frames[frame] = std::move(group);
    }
  }
  std::vector<NarrowSet> sets;
  for (const Task task : tasks) {
    for (const auto& [kind, frames] : kinds) {
      sets.push_back({broad, task, kind.first, kind.second, frames});
    }
  }
  return sets;
}

}  // namespace touchstone::measure
