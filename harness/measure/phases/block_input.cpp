// Plays a block's scene and finds its true pairs.
#include "harness/measure/phases/block_input.h"

#include <fmt/core.h>

#include <map>
#include <utility>

#include "harness/measure/phases/overlapping_pairs.h"
#include "harness/scene/player.h"

namespace touchstone::measure {

std::vector<ConcaveBody> concave_bodies(const scene::Scene& scene) {
  std::vector<ConcaveBody> bodies;
  for (std::size_t i = 0; i < scene.shapes.size(); ++i) {
    const ConcaveBody* body = scene.concave_of(i);
    bodies.push_back(body != nullptr ? *body : ConcaveBody{nullptr, {{scene.shapes[i], Pose{}}}});
  }
  return bodies;
}

BlockInput::BlockInput(const scene::Scene& scene, scene::BoxKind kind, bool with_poses)
    : shapes(scene.shapes) {
  for (const scene::Body& body : scene.bodies) shape_of.push_back(body.shape);
  if (!scene.concave.empty()) {
    bodies = concave_bodies(scene);
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      const ConcaveBody* body = scene.concave_of(i);
      kinds.emplace_back(body == nullptr         ? ""
                         : body->mesh == nullptr ? "compound"
                         : body->mesh->solid     ? "solid"
                                                 : "mesh");
    }
  }
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

std::string NarrowSet::kind_name() const {
  return is_concave() ? concave_kind : grade::PairGroup{kind_a, kind_b, {}, {}}.name();
}

std::size_t NarrowSet::pairs() const {
  std::size_t total = 0;
  for (const grade::PairGroup& group : frames) total += group.size();
  return total;
}

namespace {

// The groups of each frame, by kind.
using Frames = std::vector<grade::PairGroup>;

Frames empty_frames(std::size_t count, ShapeKind a, ShapeKind b) {
  return Frames(count, grade::PairGroup{a, b, {}, {}});
}

class Sets {
 public:
  Sets(const BlockInput& input, std::size_t frames) : input_(&input), frames_(frames) {}

  void add(std::size_t frame, std::span<const IndexPair> pairs) {
    std::vector<IndexPair> convex;
    for (const IndexPair& pair : pairs) {
      if (input_->is_concave(pair.a) || input_->is_concave(pair.b)) {
        add_concave(frame, pair.a, pair.b);
      } else if (!input_->kinds.empty()) {
        convex.push_back(pair);
      }
    }
    if (!input_->kinds.empty()) pairs = convex;
    for (grade::PairGroup& group : grade::group_by_kind(pairs, input_->shapes, input_->shape_of)) {
      Frames& frames = convex_[{group.kind_a, group.kind_b}];
      if (frames.empty()) frames = empty_frames(frames_, group.kind_a, group.kind_b);
      frames[frame] = std::move(group);
    }
  }

  std::vector<NarrowSet> sets(const std::string& broad,
                              std::span<const record::QueryTask> tasks) const {
    std::vector<NarrowSet> sets;
    for (const record::QueryTask task : tasks) {
      if (record::narrow_task(task)) {
        for (const auto& [kind, frames] : convex_) {
          sets.push_back({broad, task, kind.first, kind.second, frames});
        }
      }
      if (!record::concave_task(task)) continue;
      for (const auto& [kind, frames] : concave_) {
        sets.push_back({broad, task, frames[0].kind_a, frames[0].kind_b, frames, kind});
      }
    }
    return sets;
  }

 private:
  std::string_view kind(std::uint32_t body) const {
    const std::uint32_t shape = input_->shape_of[body];
    return input_->kinds[shape].empty() ? to_string(input_->shapes[shape].kind)
                                        : input_->kinds[shape];
  }

  void add_concave(std::size_t frame, std::uint32_t first, std::uint32_t second) {
    if (kind(first) > kind(second)) std::swap(first, second);
    Frames& frames = concave_[fmt::format("{}-{}", kind(first), kind(second))];
    const auto shape_kind = [&](std::uint32_t body) {
      return input_->shapes[input_->shape_of[body]].kind;
    };
    if (frames.empty()) frames = empty_frames(frames_, shape_kind(first), shape_kind(second));
    frames[frame].first.push_back(first);
    frames[frame].second.push_back(second);
  }

  const BlockInput* input_;
  std::size_t frames_;
  std::map<std::pair<ShapeKind, ShapeKind>, Frames> convex_;
  std::map<std::string, Frames> concave_;
};

}  // namespace

std::vector<NarrowSet> narrow_sets(const BlockInput& input, const std::string& broad,
                                   std::span<const std::vector<IndexPair>> pairs,
                                   std::span<const record::QueryTask> tasks) {
  Sets sets(input, pairs.size());
  for (std::size_t frame = 0; frame < pairs.size(); ++frame) sets.add(frame, pairs[frame]);
  return sets.sets(broad, tasks);
}

}  // namespace touchstone::measure
