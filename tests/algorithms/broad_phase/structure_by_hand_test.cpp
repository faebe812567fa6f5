// What our broad phases show of themselves for pictures, by hand on small scenes, and how fine it is.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "algorithms/kernels/boxes/aabb_measure.h"
#include "algorithms/registry.h"
#include "tests/algorithms/broad_phase/box_sets.h"

namespace touchstone {
namespace {

using Structure = std::vector<StructureBox>;

Structure structure_of(const std::string& name, std::span<const Aabb> boxes) {
  Executor executor(1);
  const auto algorithm = registry::find<BroadPhaseEntry>(name)->make(executor);
  algorithm->build(boxes);
  return algorithm->structure();
}

// Unit cubes on the x axis, 10 apart.
std::vector<Aabb> cubes_in_a_row(std::size_t count) {
  std::vector<Aabb> boxes;
  for (std::size_t i = 0; i < count; ++i) {
    const float x = 10 * static_cast<float>(i);
    boxes.push_back({{x, 0, 0}, {x + 1, 1, 1}});
  }
  return boxes;
}

TEST(StructureByHand, UniformGrid) {
  // Cells have twice the size of the cubes; each cube is at the beginning of its own.
  Structure expected;
  for (int i = 0; i < 20; ++i) {
    const float x = 10 * static_cast<float>(i);
    expected.push_back({{{x, 0, 0}, {x + 2, 2, 2}}, 1});
  }
  EXPECT_EQ(structure_of("uniform-grid", cubes_in_a_row(20)), expected);
  // A box over all cells lies in none. The last cell on an axis has all that comes after it.
  std::vector<Aabb> boxes = cubes_in_a_row(200);
  boxes.push_back({{0, 0, 0}, {2000, 1, 5}});
  const Structure with_large = structure_of("uniform-grid", boxes);
  ASSERT_EQ(with_large.size(), 201u);
  EXPECT_EQ(with_large[0], (StructureBox{boxes.back(), 0}));
  EXPECT_EQ(with_large[7], (StructureBox{{{60, 0, 0}, {62, 2, 5}}, 1}));
}

TEST(StructureByHand, HierarchicalGridHasALevelForEachSize) {
  // Dust, and boxes of a hundred times its size: two classes, of which the larger is the coarser.
  Random random(9);
  std::vector<Aabb> boxes = uniform_boxes(random, 1'000, 0.002f);
  const std::vector<Aabb> large = uniform_boxes(random, 100, 0.2f);
  boxes.insert(boxes.end(), large.begin(), large.end());
  std::map<std::uint32_t, double> sides;
  for (const StructureBox& cell : structure_of("hierarchical-grid", boxes)) {
    sides[cell.level] = std::max(sides[cell.level], sum_of_sides(cell.box));
  }
  ASSERT_GE(sides.size(), 2u);
  EXPECT_EQ(sides.rbegin()->first, sides.size() - 1);
  EXPECT_GT(sides.begin()->second, sides.rbegin()->second);
}

TEST(StructureByHand, Trees) {
  // One leaf of 16, and as many levels above it as the tree has for it.
  const std::vector<Aabb> few = cubes_in_a_row(16);
  const Aabb all{{0, 0, 0}, {151, 1, 1}};
  EXPECT_EQ(structure_of("linear-bvh", few), (Structure{{all, 0}}));
  EXPECT_EQ(structure_of("kd-tree", few), (Structure{{all, 0}}));
  EXPECT_EQ(structure_of("dynamic-bvh", few), (Structure{{all, 0}}));
  EXPECT_EQ(structure_of("packed-rtree", few), (Structure{{all, 0}, {all, 1}}));
  EXPECT_EQ(structure_of("loose-octree", few), (Structure{{all, 0}, {all, 1}}));
  // A leaf for each half.
  const std::vector<Aabb> more = cubes_in_a_row(64);
  EXPECT_EQ(structure_of("kd-tree", more), (Structure{{{{0, 0, 0}, {631, 1, 1}}, 0},
                                                      {{{0, 0, 0}, {311, 1, 1}}, 1},
                                                      {{{320, 0, 0}, {631, 1, 1}}, 1}}));
}

TEST(StructureByHand, Intervals) {
  // They lie far apart on one axis alone, which is the one that is sorted.
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto turned = [&](Aabb box) {
      std::swap(box.min[0], box.min[axis]);
      std::swap(box.max[0], box.max[axis]);
      return box;
    };
    const std::vector<Aabb> boxes = {turned({{5, 2, -1}, {6, 4, 8}}),
                                     turned({{1, 3, 0}, {2, 3, 9}})};
    const Structure expected = {{turned({{1, 2, -1}, {2, 2, -1}}), 0},
                                {turned({{5, 2, -1}, {6, 2, -1}}), 0}};
    for (const char* name : {"sweep-one-axis", "sweep-three-axes", "sweep-and-prune"}) {
      Structure structure = structure_of(name, boxes);
      std::ranges::sort(structure, {}, [](const StructureBox& own) { return own.box.min; });
      EXPECT_EQ(structure, expected) << name << ' ' << axis;
    }
  }
}

// A root alone would hold all bodies, and so would a single cell: each begins in a small region.
TEST(StructureByHand, IsAsFineAsTheBodiesAreMany) {
  Random random(6);
  const std::vector<Aabb> bodies = uniform_boxes(random, 5'000, 0.02f);
  for (const BroadPhaseEntry& entry : registry::entries<BroadPhaseEntry>()) {
    if (entry.info.origin != Origin::ours || entry.info.name == "naive") continue;
    SCOPED_TRACE(entry.info.name);
    Structure structure = structure_of(entry.info.name, bodies);
    EXPECT_GT(structure.size(), bodies.size() / 64);
    if (entry.info.name.starts_with("sweep-")) continue;
    std::erase_if(structure, [](const StructureBox& box) { return sum_of_sides(box.box) > 1; });
    EXPECT_TRUE(std::ranges::all_of(bodies, [&](const Aabb& body) {
      return std::ranges::any_of(structure, [&](const StructureBox& box) {
        return contains(box.box, {body.min, body.min});
      });
    }));
  }
}

}  // namespace
}  // namespace touchstone
