// Plays a block's scene, and finds its true pairs with a binary tree of boxes.
#include "harness/measure/block_input.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <utility>

#include "algorithms/registry.h"
#include "harness/scene/player.h"

namespace touchstone::measure {
namespace {

Aabb hull_of(const Aabb& a, const Aabb& b) {
  Aabb hull = a;
  for (std::size_t i = 0; i < 3; ++i) {
    hull.min[i] = std::min(a.min[i], b.min[i]);
    hull.max[i] = std::max(a.max[i], b.max[i]);
  }
  return hull;
}

// A binary tree over the boxes, split at the median centre, and traversed against itself.
class Tree {
 public:
  explicit Tree(std::span<const Aabb> boxes) {
    for (std::uint32_t id = 0; id < boxes.size(); ++id) {
      if (!boxes[id].is_empty()) items_.push_back({boxes[id], id});
    }
    if (!items_.empty()) split(0, items_.size());
  }

  std::vector<IndexPair> pairs() {
    found_.clear();
    if (!nodes_.empty()) meet(0);
    std::ranges::sort(found_);
    return std::move(found_);
  }

 private:
  struct Item {
    Aabb box;
    std::uint32_t id;
  };
  struct Node {
    Aabb box;
    std::size_t first, last;  // items
    std::size_t left, right;  // nodes; 0 in a leaf
    bool is_leaf() const { return left == 0; }
  };
  static constexpr std::size_t leaf_size = 8;

  // The centre times two.
  static double centre(const Item& item, std::size_t axis) {
    return static_cast<double>(item.box.min[axis]) + static_cast<double>(item.box.max[axis]);
  }

  std::size_t longest_axis(std::size_t first, std::size_t last) const {
    std::size_t longest = 0;
    double greatest = -1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      double low = std::numeric_limits<double>::max(), high = -low;
      for (std::size_t i = first; i < last; ++i) {
        low = std::min(low, centre(items_[i], axis));
        high = std::max(high, centre(items_[i], axis));
      }
      if (high - low > greatest) {
        greatest = high - low;
        longest = axis;
      }
    }
    return longest;
  }

  std::size_t split(std::size_t first, std::size_t last) {
    const std::size_t place = nodes_.size();
    nodes_.push_back({items_[first].box, first, last, 0, 0});
    if (last - first <= leaf_size) {
      Aabb box = items_[first].box;
      for (std::size_t i = first; i < last; ++i) box = hull_of(box, items_[i].box);
      nodes_[place].box = box;
      return place;
    }
    const std::size_t middle = first + (last - first) / 2, axis = longest_axis(first, last);
    const auto at = [&](std::size_t i) { return items_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(first), at(middle), at(last), [axis](const Item& a, const Item& b) {
      return centre(a, axis) < centre(b, axis);
    });
    const std::size_t left = split(first, middle), right = split(middle, last);
    nodes_[place].left = left;
    nodes_[place].right = right;
    nodes_[place].box = hull_of(nodes_[left].box, nodes_[right].box);
    return place;
  }

  void test(const Item& a, const Item& b) {
    if (overlap(a.box, b.box)) found_.push_back({std::min(a.id, b.id), std::max(a.id, b.id)});
  }

  void meet(std::size_t place) {
    const Node& node = nodes_[place];
    if (node.is_leaf()) {
      for (std::size_t i = node.first; i < node.last; ++i) {
        for (std::size_t j = i + 1; j < node.last; ++j) test(items_[i], items_[j]);
      }
      return;
    }
    meet(node.left);
    meet(node.right);
    cross(nodes_[node.left], nodes_[node.right]);
  }

  void cross(const Node& a, const Node& b) {
    if (!overlap(a.box, b.box)) return;
    if (a.is_leaf() && b.is_leaf()) {
      for (std::size_t i = a.first; i < a.last; ++i) {
        for (std::size_t j = b.first; j < b.last; ++j) test(items_[i], items_[j]);
      }
      return;
    }
    const bool into_a = !a.is_leaf() && (b.is_leaf() || a.last - a.first >= b.last - b.first);
    const Node& opened = into_a ? a : b;
    const Node& other = into_a ? b : a;
    cross(nodes_[opened.left], other);
    cross(nodes_[opened.right], other);
  }

  std::vector<Item> items_;
  std::vector<Node> nodes_;
  std::vector<IndexPair> found_;
};

}  // namespace

std::vector<IndexPair> overlapping_pairs(std::span<const Aabb> boxes,
                                         std::size_t most_to_test_all) {
  if (boxes.size() > most_to_test_all) return Tree(boxes).pairs();
  Executor executor(1);
  PairSink sink;
  const std::unique_ptr<BroadPhase> naive =
      registry::find<BroadPhaseEntry>("naive")->make(executor);
  naive->build(boxes);
  naive->find_pairs(sink);
  std::vector<IndexPair> pairs = sink.gather();
  std::ranges::sort(pairs);
  return pairs;
}

std::vector<ConcaveBody> concave_bodies(const scene::Scene& scene) {
  std::vector<ConcaveBody> bodies;
  for (std::size_t i = 0; i < scene.shapes.size(); ++i) {
    const ConcaveBody* body = scene.concave_of(i);
    bodies.push_back(body != nullptr ? *body : ConcaveBody{nullptr, {{scene.shapes[i], Pose{}}}});
  }
  return bodies;
}

BlockInput::BlockInput(const scene::Scene& scene, scene::BoxKind kind, bool with_poses)
    : shapes(scene.shapes), filter(scene.filter) {
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
  for (std::size_t frame = 0; frame < pairs.size(); ++frame) {
    if (input.filter.is_empty()) {
      sets.add(frame, pairs[frame]);
    } else {
      std::vector<IndexPair> asked = pairs[frame];
      input.filter.apply(asked);
      sets.add(frame, asked);
    }
  }
  return sets.sets(broad, tasks);
}

}  // namespace touchstone::measure
