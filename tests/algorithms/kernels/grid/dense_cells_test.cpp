#include "algorithms/kernels/grid/dense_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

#include "algorithms/broad_phase/hierarchical_grid/grid_levels.h"
#include "algorithms/broad_phase/loose_octree/octree_order.h"
#include "algorithms/core/executor/executor.h"

namespace touchstone {
namespace {

using Random = std::mt19937_64;

float uniform(Random& random, float high) {
  return high * static_cast<float>(random() >> 40) * 0x1p-24f;
}

// All but one in twenty in a cluster, in a world `width` times as wide.
std::vector<Aabb> cluster(Random& random, std::size_t count, float width) {
  std::vector<Aabb> boxes(count);
  for (std::size_t i = 0; i < count; ++i) {
    const float range = i % 20 == 0 ? width : 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      boxes[i].min[axis] = uniform(random, range);
      boxes[i].max[axis] = boxes[i].min[axis] + 0.01f + uniform(random, 0.05f);
    }
  }
  return boxes;
}

std::vector<std::uint32_t> all_ids(std::size_t count) {
  std::vector<std::uint32_t> ids(count);
  std::iota(ids.begin(), ids.end(), 0u);
  return ids;
}

TEST(DenseCells, AreTheLongestRuns) {
  Random random(1);
  std::size_t found_in_all = 0;
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<int> keys;
    for (int key = 0; keys.size() < 300; ++key) keys.insert(keys.end(), 1 + random() % 20, key);
    for (const std::size_t least : {2, 5, 8, 11}) {
      std::vector<std::size_t> found, expected;
      visit_dense_cells(
          {3, keys.size()}, least, [&](std::size_t i) { return keys[i]; },
          [&](IndexRange run) {
            found.insert(found.end(), {run.first, run.last});
          });
      for (std::size_t first = 3, last = 3; first < keys.size(); first = last) {
        while (last < keys.size() && keys[last] == keys[first]) ++last;
        if (last - first >= least) expected.insert(expected.end(), {first, last});
      }
      EXPECT_EQ(found, expected);
      found_in_all += found.size();
    }
  }
  EXPECT_GT(found_in_all, 1000u);
}

TEST(DenseCells, AreSortedOnTheAxisWhereTheyLieFarApart) {
  Executor executor(1);
  Random random(2);
  std::vector<Aabb> boxes(500);  // plates, far apart for their thickness, which is on y
  for (Aabb& box : boxes) {
    box.min = {uniform(random, 20), uniform(random, 5), uniform(random, 20)};
    box.max = {box.min[0] + 10, box.min[1] + 0.01f, box.min[2] + 10};
  }
  std::vector<std::uint32_t> dense_cell = all_ids(boxes.size());
  DenseCellSort<std::uint32_t> sort;
  const int axis =
      sort(executor, boxes, std::span(dense_cell), [](std::uint32_t id) { return id; });
  EXPECT_EQ(axis, 1);
  EXPECT_TRUE(
      std::ranges::is_sorted(dense_cell, {}, [&](std::uint32_t id) { return boxes[id].min[1]; }));
  std::ranges::sort(dense_cell);
  EXPECT_EQ(dense_cell, all_ids(boxes.size()));
}

TEST(GridLevels, FindEachBoxInItsCell) {
  Random random(3);
  for (const int width : {1, 3}) {
    Executor executor(width);
    GridLevels grids;
    for (const float world : {1.0f, 1e3f, 1e6f}) {
      const std::vector<Aabb> boxes = cluster(random, 20'000, world);
      grids.sort(executor, boxes, all_ids(boxes.size()), 16);
      std::vector<std::uint32_t> ids;
      std::size_t most_in_a_cell = 0;
      for (const GridLevels::Level& level : grids.levels()) {
        ASSERT_EQ(level.boxes.first, ids.size());
        for (std::size_t place = level.boxes.first; place < level.boxes.last; ++place) {
          ids.push_back(grids.id(place));
          const std::uint64_t cell = level.grid.cell_of(boxes[grids.id(place)]);
          ASSERT_EQ(cell, grids.cell(level, place));
          const std::size_t first = grids.find(level, cell);
          const std::size_t last = grids.find(level, cell + 1);
          ASSERT_TRUE(level.boxes.first <= first && first <= place && place < last &&
                      last <= level.boxes.last);
          most_in_a_cell = std::max(most_in_a_cell, last - first);
        }
      }
      EXPECT_LT(most_in_a_cell, 256u);
      std::ranges::sort(ids);
      EXPECT_EQ(ids, all_ids(boxes.size()));
    }
  }
}

TEST(OctreeOrder, HasLargeBoxesFirstAndAllOfACellOneBehindTheOther) {
  Executor executor(3);
  Random random(4);
  std::vector<Aabb> boxes = cluster(random, 5000, 1);
  for (std::size_t i = 0; i < boxes.size(); i += 10) {
    for (float& max : boxes[i].max) max += 0.4f;
  }
  OctreeOrder order;
  order.sort(executor, boxes, all_ids(boxes.size()));
  ASSERT_EQ(order.size(), boxes.size());
  std::vector<std::uint32_t> ids;
  std::size_t large = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    ids.push_back(order.id(i));
    EXPECT_LE(order.key(i == 0 ? 0 : i - 1), order.key(i));
    // The cell is at least as wide: half of the world instead of its quarter.
    if (order.id(i) % 10 == 0) {
      EXPECT_LE(OctreeOrder::depth(order.key(i)), 1);
      ++large;
    } else {
      EXPECT_GE(OctreeOrder::depth(order.key(i)), 3);
    }
  }
  EXPECT_EQ(large, 500u);
  std::ranges::sort(ids);
  EXPECT_EQ(ids, all_ids(boxes.size()));
}

TEST(OctreeOrder, TellsACrowdApart) {
  Executor executor(1);
  Random random(5);
  std::vector<Aabb> boxes = cluster(random, 4000, 1e7f);
  OctreeOrder order;
  order.sort(executor, boxes, all_ids(boxes.size()));
  std::vector<IndexRange> dense_cells;
  visit_dense_cells(
      {0, order.size()}, 1000, [&](std::size_t i) { return order.key(i); },
      [&](IndexRange run) { dense_cells.push_back(run); });
  ASSERT_EQ(dense_cells.size(), 1u);
  EXPECT_TRUE(order.refine(executor, boxes, dense_cells[0].first, dense_cells[0].last));
  std::size_t different = 0;
  for (std::size_t i = dense_cells[0].first + 1; i < dense_cells[0].last; ++i) {
    EXPECT_LE(order.key(i - 1), order.key(i));
    different += order.key(i - 1) != order.key(i) ? 1 : 0;
  }
  EXPECT_GT(different, 1000u);
  // Boxes at one place cannot be distinguished.
  const std::vector<Aabb> same(100, Aabb{{1, 1, 1}, {2, 2, 2}});
  order.sort(executor, same, all_ids(same.size()));
  EXPECT_FALSE(order.refine(executor, same, 0, same.size()));
}

}  // namespace
}  // namespace touchstone
