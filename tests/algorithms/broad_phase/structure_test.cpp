// What our broad phases show of themselves for pictures: every body is where they say it is.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <tuple>

#include "algorithms/kernels/boxes/aabb_measure.h"
#include "algorithms/registry.h"
#include "tests/algorithms/broad_phase/box_sets.h"
#include "tests/algorithms/one_in.h"

namespace touchstone {
namespace {

// What a broad phase shows. A Verlet list has a tree while it has no list, and then fat boxes; auto
// shows what the one in charge does, which may be a sweep's intervals.
enum class Kind { nothing, cells, intervals, tree, tree_or_fat_boxes, one_in_charge };

const std::map<std::string, Kind> kinds = {
    {"naive", Kind::nothing},
    {"uniform-grid", Kind::cells},
    {"hierarchical-grid", Kind::cells},
    {"sweep-one-axis", Kind::intervals},
    {"sweep-three-axes", Kind::intervals},
    {"sweep-and-prune", Kind::intervals},
    {"loose-octree", Kind::tree},
    {"kd-tree", Kind::tree},
    {"linear-bvh", Kind::tree},
    {"packed-rtree", Kind::tree},
    {"dynamic-bvh", Kind::tree},
    {"verlet-list", Kind::tree_or_fat_boxes},
    {"auto", Kind::one_in_charge},
};

std::vector<const BroadPhaseEntry*> all_of_ours() {
  std::vector<const BroadPhaseEntry*> list;
  for (const BroadPhaseEntry& entry : registry::entries<BroadPhaseEntry>()) {
    if (entry.info.origin == Origin::ours) list.push_back(&entry);
  }
  return list;
}

using Structure = std::vector<StructureBox>;

bool is_box(const Aabb& box) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!std::isfinite(box.min[axis]) || !std::isfinite(box.max[axis])) return false;
    if (box.min[axis] > box.max[axis]) return false;
  }
  return true;
}

Aabb point(const std::array<float, 3>& at) { return {at, at}; }

std::vector<Aabb> present(std::span<const Aabb> boxes) {
  std::vector<Aabb> list;
  std::ranges::copy_if(boxes, std::back_inserter(list),
                       [](const Aabb& box) { return !box.is_empty(); });
  return list;
}

// One root around all bodies, and each node in one of the level above.
void check_tree(const Structure& nodes, std::span<const Aabb> bodies) {
  std::map<std::uint32_t, std::vector<Aabb>> levels;
  for (const StructureBox& node : nodes) levels[node.level].push_back(node.box);
  ASSERT_EQ(levels[0].size(), 1u);
  for (const Aabb& body : bodies) EXPECT_TRUE(contains(levels[0][0], body));
  for (const auto& [level, boxes] : levels) {
    if (level == 0) continue;
    ASSERT_TRUE(levels.contains(level - 1)) << level;
    for (const Aabb& box : boxes) {
      EXPECT_TRUE(std::ranges::any_of(levels[level - 1],
                                      [&](const Aabb& parent) { return contains(parent, box); }));
    }
  }
}

// Each body begins in a cell, and no cell is without a body.
void check_cells(const Structure& cells, std::span<const Aabb> bodies) {
  for (const Aabb& body : bodies) {
    EXPECT_TRUE(std::ranges::any_of(
        cells, [&](const StructureBox& cell) { return contains(cell.box, point(body.min)); }));
  }
  for (const StructureBox& cell : cells) {
    EXPECT_TRUE(
        std::ranges::any_of(bodies, [&](const Aabb& body) { return overlap(cell.box, body); }));
  }
}

void sort_boxes(std::vector<Aabb>& boxes) {
  std::ranges::sort(boxes, {}, [](const Aabb& box) { return std::tuple(box.min, box.max); });
}

// The bodies' own intervals on one axis, flat at the corner of the scene.
void check_intervals(const Structure& intervals, std::span<const Aabb> bodies) {
  std::vector<Aabb> found;
  for (const StructureBox& interval : intervals) {
    EXPECT_EQ(interval.level, 0u);
    found.push_back(interval.box);
  }
  sort_boxes(found);
  Aabb scene = bodies[0];
  for (const Aabb& body : bodies) {
    for (std::size_t i = 0; i < 3; ++i) scene.min[i] = std::min(scene.min[i], body.min[i]);
  }
  const auto is_of = [&](std::size_t axis) {
    std::vector<Aabb> expected;
    for (const Aabb& body : bodies) {
      Aabb box = point(scene.min);
      box.min[axis] = body.min[axis];
      box.max[axis] = body.max[axis];
      expected.push_back(box);
    }
    sort_boxes(expected);
    return found == expected;
  };
  EXPECT_TRUE(is_of(0) || is_of(1) || is_of(2));
}

// Whether the boxes are flat on all axes but one.
bool are_intervals(const Structure& structure) {
  return std::ranges::all_of(structure, [](const StructureBox& box) {
    int flat = 0;
    for (std::size_t i = 0; i < 3; ++i) flat += box.box.min[i] == box.box.max[i] ? 1 : 0;
    return flat >= 2;
  });
}

// A box around each body, in the order of the bodies.
void check_fat_boxes(const Structure& boxes, std::span<const Aabb> bodies) {
  ASSERT_EQ(boxes.size(), bodies.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) EXPECT_TRUE(contains(boxes[i].box, bodies[i]));
}

// `is_built` is true after a build, and false after an update.
void check(Kind kind, const Structure& structure, std::span<const Aabb> boxes, bool is_built) {
  const std::vector<Aabb> bodies = present(boxes);
  EXPECT_EQ(structure.empty(), kind == Kind::nothing || bodies.empty());
  EXPECT_TRUE(
      std::ranges::all_of(structure, [](const StructureBox& box) { return is_box(box.box); }));
  if (structure.empty() || bodies.empty()) return;
  switch (kind) {
    case Kind::nothing: break;
    case Kind::cells: return check_cells(structure, bodies);
    case Kind::intervals: return check_intervals(structure, bodies);
    case Kind::tree: return check_tree(structure, bodies);
    case Kind::one_in_charge:
      if (!is_built && are_intervals(structure)) return check_intervals(structure, bodies);
      [[fallthrough]];
    case Kind::tree_or_fat_boxes:
      return is_built || std::ranges::any_of(structure, &StructureBox::level)
                 ? check_tree(structure, bodies)
                 : check_fat_boxes(structure, bodies);
  }
}

std::vector<IndexPair> pairs_of(BroadPhase& algorithm) {
  PairSink sink;
  EXPECT_EQ(algorithm.find_pairs(sink), Status::ok);
  std::vector<IndexPair> pairs = sink.gather();
  std::ranges::sort(pairs);
  return pairs;
}

// Bodies of which some move a little, jump, come and go.
class ChangingBodies {
 public:
  ChangingBodies(std::size_t count, float side)
      : side_(side), boxes_(uniform_boxes(random_, count, side)) {}

  std::span<const Aabb> boxes() const { return boxes_; }

  // Shares of the bodies; those that move go up to `reach` far.
  FrameChange next(float moved, float reach, float changed) {
    moved_.clear(), inserted_.clear(), removed_.clear();
    boxes_.resize(boxes_.size() + (changed > 0 ? 1 : 0), Aabb::empty());
    for (std::uint32_t id = 0; id < boxes_.size(); ++id) {
      Aabb& box = boxes_[id];
      const float dice = uniform(random_, 0, 1);
      if (box.is_empty() && dice < 10 * changed) {
        box = fresh();
        inserted_.push_back(id);
      } else if (!box.is_empty() && dice < changed) {
        box = Aabb::empty();
        removed_.push_back(id);
      } else if (!box.is_empty() && dice < 2 * changed) {
        box = fresh();
        moved_.push_back(id);
      } else if (!box.is_empty() && dice < 2 * changed + moved) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const float by = uniform(random_, -reach, reach);
          box.min[axis] += by;
          box.max[axis] += by;
        }
        moved_.push_back(id);
      }
    }
    return {boxes_, moved_, inserted_, removed_};
  }

 private:
  Aabb fresh() { return uniform_boxes(random_, 1, side_)[0]; }

  Random random_{11};
  float side_;
  std::vector<Aabb> boxes_;
  std::vector<std::uint32_t> moved_, inserted_, removed_;
};

TEST(Structure, IsKnownOfEachOfOurs) {
  std::size_t count = 0;
  for (const BroadPhaseEntry* entry : all_of_ours()) {
    EXPECT_TRUE(kinds.contains(entry->info.name)) << "say what it shows: " << entry->info.name;
    ++count;
  }
  EXPECT_EQ(count, kinds.size());
}

TEST(Structure, IsEmptyBeforeTheFirstBuildAndWithoutBodies) {
  for (const BroadPhaseEntry* entry : all_of_ours()) {
    SCOPED_TRACE(entry->info.name);
    Executor executor(1);
    const auto algorithm = entry->make(executor);
    EXPECT_TRUE(algorithm->structure().empty());
    Random random(1);
    const std::vector<Aabb> some = uniform_boxes(random, 600, 0.2f);
    const std::vector<Aabb> none(600, Aabb::empty());
    std::vector<std::uint32_t> all(600);
    for (std::uint32_t id = 0; id < 600; ++id) all[id] = id;
    algorithm->build({});
    EXPECT_TRUE(algorithm->structure().empty());
    algorithm->build(some);
    algorithm->update({none, {}, {}, all});
    EXPECT_TRUE(algorithm->structure().empty());
    algorithm->update({some, {}, all, {}});
    EXPECT_EQ(algorithm->structure().empty(), entry->info.name == "naive");
    algorithm->build(none);
    EXPECT_TRUE(algorithm->structure().empty());
  }
}

TEST(Structure, HoldsEveryBody) {
  Random random(5);
  std::vector<BoxSet> sets = box_sets();
  sets.push_back({.name = "crowd", .boxes = uniform_boxes(random, drawn(5'000, 1'000), 0.05f)});
  for (const BoxSet& set : sets) {
    SCOPED_TRACE(set.name);
    const std::vector<IndexPair> truth = true_pairs(set.boxes);
    for (const BroadPhaseEntry* entry : all_of_ours()) {
      SCOPED_TRACE(entry->info.name);
      Executor executor(3);
      const auto algorithm = entry->make(executor);
      algorithm->build(set.boxes);
      const Structure structure = algorithm->structure();
      check(kinds.at(entry->info.name), structure, set.boxes, true);
      EXPECT_EQ(pairs_of(*algorithm), truth);
      EXPECT_EQ(algorithm->structure(), structure);
    }
  }
}

TEST(Structure, FollowsTheBodies) {
  for (const BroadPhaseEntry* entry : all_of_ours()) {
    SCOPED_TRACE(entry->info.name);
    Executor executor(2);
    const auto algorithm = entry->make(executor);
    ChangingBodies bodies(drawn(700, 150), 0.1f);
    algorithm->build(bodies.boxes());
    for (int frame = 0; frame < 120; ++frame) {
      SCOPED_TRACE(frame);
      // Some frames nothing changes, all creep, a few go far, or many come and go.
      const int phase = frame / 20;
      const float moved = phase == 1 || phase == 4 ? 1.0f : phase == 0 ? 0.0f : 0.05f;
      const float changed = phase == 3 && frame % 3 == 0 ? 0.05f : phase == 2 ? 0.002f : 0.0f;
      algorithm->update(bodies.next(moved, phase == 5 ? 0.2f : 0.0005f, changed));
      const Structure structure = algorithm->structure();
      check(kinds.at(entry->info.name), structure, bodies.boxes(), false);
      EXPECT_EQ(pairs_of(*algorithm), true_pairs(bodies.boxes()));
      EXPECT_EQ(algorithm->structure(), structure);
    }
  }
}

// Bodies that creep are given fattened boxes, and these are shown.
TEST(Structure, FatBoxesAreShown) {
  for (const char* name : {"verlet-list", "dynamic-bvh"}) {
    SCOPED_TRACE(name);
    Executor executor(1);
    const auto algorithm = registry::find<BroadPhaseEntry>(name)->make(executor);
    ChangingBodies bodies(500, 0.1f);
    algorithm->build(bodies.boxes());
    for (int frame = 0; frame < 6; ++frame) {
      pairs_of(*algorithm);
      algorithm->update(bodies.next(1, 0.0002f, 0));
    }
    Structure structure = algorithm->structure();
    const std::uint32_t deepest = std::ranges::max(structure, {}, &StructureBox::level).level;
    std::erase_if(structure, [&](const StructureBox& box) { return box.level != deepest; });
    ASSERT_EQ(structure.size(), 500u);
    for (const Aabb& body : bodies.boxes()) {
      EXPECT_TRUE(std::ranges::any_of(structure, [&](const StructureBox& fat) {
        return contains(fat.box, body) && fat.box != body &&
               sum_of_sides(fat.box) < 1.5 * sum_of_sides(body);
      }));
    }
  }
}

}  // namespace
}  // namespace touchstone
