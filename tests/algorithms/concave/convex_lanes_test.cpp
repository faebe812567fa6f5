// Convex bodies against triangles in lanes: verdicts against the oracle's, and how many are left open.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "algorithms/hull/convex_hull.h"
#include "algorithms/kernels/bvh/wide_search.h"
#include "algorithms/kernels/triangles/convex_signs.h"
#include "tests/algorithms/concave/agreed.h"
#include "tests/algorithms/concave/meshes.h"
#include "tests/algorithms/one_in.h"
#include "tests/algorithms/random.h"

namespace touchstone {
namespace {

using reference::Answered;
using reference::ask;
using reference::body_of;
using reference::moved_by;

Shape hull_on_sphere(reference::Random& random, int vertices, double radius) {
  std::vector<Vec3d> points;
  for (int i = 0; i < vertices; ++i) points.push_back(radius * random.direction());
  return hull_of(std::move(points));
}

// Shapes that lanes decide, degenerate ones too.
Shape lane_shape(reference::Random& random, double size) {
  switch (random.below(8)) {
    case 0: return reference::make_sphere(size);
    case 1: return reference::make_capsule(0.4 * size, 0.6 * size);
    case 2: return reference::make_box(size, 0.7 * size, 0.4 * size);
    case 3: return hull_on_sphere(random, 32, size);
    case 4: return hull_on_sphere(random, 4, size);
    case 5: return hull_on_sphere(random, 3, size);
    case 6: return reference::make_box(size, 0, 0.5 * size);
    default: return reference::make_capsule(0, size);
  }
}

// `fused` against the oracle, or against part-pairs where that is slow.
Answered expect_exact(const std::array<ConcaveBody, 2>& bodies, const Pose& a, const Pose& b,
                      const char* truth = "exact") {
  const Answered exact = ask(truth, ConcaveTask::contacts, bodies, a, b);
  const Answered found = ask("fused", ConcaveTask::contacts, bodies, a, b);
  EXPECT_EQ(found.outcome.answer, exact.outcome.answer);
  EXPECT_EQ(found.outcome.status, exact.outcome.status);
  EXPECT_EQ(found.pairs, exact.pairs);
  EXPECT_EQ(ask("fused", ConcaveTask::intersect, bodies, a, b).outcome.answer,
            exact.outcome.answer);
  return exact;
}

TEST(ConvexLanes, AgainstATorusAtAnyPose) {
  reference::Random random(1);
  const ConcaveBody torus = body_of(reference::torus(10, 6, 1, 0.3));
  int hits = 0;
  const int count = drawn(160, 40);
  for (int i = 0; i < count; ++i) {
    const ConcaveBody body = body_of(lane_shape(random, random.uniform(0.05, 0.6)));
    const Pose a = {random.rotation(), random.vector(2)};
    const Pose b = {random.rotation(), a(random.vector(1).cwiseProduct(Vec3d(1.2, 1.2, 0.4)))};
    hits += (i % 2 == 0 ? expect_exact({torus, body}, a, b) : expect_exact({body, torus}, b, a))
                .meets();
  }
  EXPECT_GT(hits, count / 5);
  EXPECT_LT(hits, count * 9 / 10);
}

// A flat grid of squares, and bodies that lie on it, over it and in it by hair's breadths.
TEST(ConvexLanes, FlushOnAFlatTerrain) {
  reference::Random random(2);
  std::vector<std::array<Vec3d, 3>> triangles;
  for (int x = -2; x < 2; ++x) {
    for (int y = -2; y < 2; ++y) {
      triangles.push_back({Vec3d(x, y, 0), Vec3d(x + 1, y, 0), Vec3d(x + 1, y + 1, 0)});
      triangles.push_back({Vec3d(x, y, 0), Vec3d(x + 1, y + 1, 0), Vec3d(x, y + 1, 0)});
    }
  }
  const ConcaveBody terrain = reference::mesh_of(triangles);
  int hits = 0, misses = 0;
  for (const double off : {0.0, 1e-3, 1e-9, 1e-12, 1e-15, -1e-3, -1e-9, -1e-12, -1e-15}) {
    for (const double size : {0.25, 1.0}) {
      const Shape cube_hull = hull_of([&] {
        std::vector<Vec3d> corners;
        for (int i = 0; i < 8; ++i) {
          corners.push_back(size * Vec3d(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
        }
        return corners;
      }());
      const std::vector<std::pair<Shape, double>> bodies = {
          {reference::make_sphere(size), size},
          {reference::make_capsule(size, 0.5), size + 0.5},
          {reference::make_box(size, size, size), size},
          {cube_hull, size}};
      for (const auto& [shape, height] : bodies) {
        const Vec3d place(random.below(5) / 2.0 - 1, random.below(5) / 4.0 - 0.5, height + off);
        const Answered answered =
            expect_exact({terrain, body_of(shape)}, {}, moved_by(place), "part-pairs");
        EXPECT_EQ(answered.meets(), height + off <= height);
        ++(answered.meets() ? hits : misses);
        // The same far away, and turned alike.
        const Pose far = {random.rotation(), 1e6 * random.direction()};
        Pose on = far;
        on.translation = far(place);
        expect_exact({terrain, body_of(shape)}, far, on, "part-pairs");
      }
    }
  }
  EXPECT_GT(hits, 20);
  EXPECT_GT(misses, 20);
}

TEST(ConvexLanes, DegenerateTrianglesAndStretchedPoses) {
  reference::Random random(3);
  int hits = 0;
  const int count = drawn(400, 40);
  for (int i = 0; i < count; ++i) {
    const Vec3d p = random.vector(0.6), q = random.vector(0.6);
    const ConcaveBody flat = reference::mesh_of(
        {{p, q, p}, {p, p, p}, {p, (p + q) / 2, q}, {p, q, p + 1e-9 * random.vector(1)}});
    const ConcaveBody body = body_of(lane_shape(random, 0.4));
    Pose a = {random.rotation(), random.vector(0.2)}, b = {random.rotation(), {0, 0, 0}};
    if (i % 4 == 0) a.rotation *= 2;
    if (i % 4 == 1) b.rotation *= 0.5;
    if (i % 4 == 2) b.rotation = b.rotation.cast<float>().cast<double>();
    hits += expect_exact({flat, body}, a, b).meets();
  }
  EXPECT_GT(hits, count / 10);
  EXPECT_LT(hits, count);
}

// A ball around a core is a ball in the world, which the box of a shrunk body does not enclose.
TEST(ConvexLanes, ShrunkRoundBodiesWithEachMidPhase) {
  reference::Random random(6);
  const ConcaveBody corner = reference::mesh_of({{Vec3d(0, 0, 0), Vec3d(1, 0, 0), Vec3d(0, 1, 0)}});
  ConcaveBody box = body_of(reference::make_box(0.1, 0.1, 0.1));
  int hits = 0, all = 0;
  for (const MidPhaseEntry& mid : registry::entries<MidPhaseEntry>()) {
    if (mid.make == nullptr) continue;
    SCOPED_TRACE(mid.info.name);
    for (int i = 0; i < drawn(60, 20); ++i) {
      ConcaveBody round;
      for (const double x : {-0.25, 0.5}) {
        const Shape shape =
            i % 2 == 0 ? reference::make_sphere(0.5) : reference::make_capsule(0.5, 0.25);
        round.parts.push_back({shape, moved_by({x, 0, 0}), 0});
      }
      const Pose a = {random.rotation(), random.vector(0.2)};
      Pose b = {random.rotation(), random.vector(0.7)};
      if (i % 3 == 0) b.rotation *= 0.5;
      if (i % 3 == 1) b.rotation *= Vec3d(1, 0.01, 2).asDiagonal();
      if (i % 3 == 2) b.rotation *= Vec3d(1, 0, 1).asDiagonal();
      const std::array<ConcaveBody, 2> bodies = {i % 5 == 0 ? box : corner, round};
      const Answered truth = ask("exact", ConcaveTask::contacts, bodies, a, b);
      for (const char* name : {"fused", "part-pairs"}) {
        SCOPED_TRACE(name);
        EXPECT_EQ(ask(name, ConcaveTask::contacts, bodies, a, b, mid.info.name).pairs, truth.pairs);
        const Answered distance = ask(name, ConcaveTask::distance, bodies, a, b, mid.info.name);
        EXPECT_EQ(distance.outcome.answer, truth.outcome.answer);
      }
      hits += truth.meets();
      ++all;
    }
  }
  EXPECT_GT(hits, all / 10);
  EXPECT_LT(hits, all * 9 / 10);
}

TEST(ConvexLanes, TinyAndHuge) {
  reference::Random random(4);
  int hits = 0, all = 0;
  for (const double size : {1e-170, 1e-150, 1e-30, 1e30, 1e100, 1e150}) {
    SCOPED_TRACE(size);
    for (int i = 0; i < 8; ++i) {
      const ConcaveBody triangle = reference::mesh_of(
          {{size * random.vector(1), size * random.vector(1), size * random.vector(1)}});
      const ConcaveBody body = body_of(lane_shape(random, 0.5 * size));
      const Pose b = {random.rotation(), size * random.vector(0.7)};
      hits += expect_exact({triangle, body}, {}, b).meets();
      ++all;
    }
  }
  EXPECT_GT(hits, all / 6);
  EXPECT_LT(hits, all);
}

// Lanes decide all but what nearly touches, and alike at every level of instructions.
TEST(ConvexLanes, LeaveLittleOpen) {
  reference::Random random(5);
  int open = 0, yes = 0, all = 0;
  for (int i = 0; i < drawn(1000, 100); ++i) {
    const int kind = i % 4;
    const LaneConvex convex(kind == 0   ? reference::make_sphere(0.5)
                            : kind == 1 ? reference::make_capsule(0.3, 0.5)
                            : kind == 2 ? reference::make_box(0.5, 0.4, 0.3)
                                        : hull_on_sphere(random, 32, 0.6));
    TriangleBlock block;
    for (std::size_t lane = 0; lane < TriangleBlock::size; ++lane) {
      const Vec3d at = random.vector(0.6);
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3d corner = at + random.vector(0.3);
        for (std::size_t axis = 0; axis < 3; ++axis) {
          block.at[3 * k + axis][lane] = corner[static_cast<int>(axis)];
        }
      }
    }
    LaneVerdicts first;
    for (const Isa level : isa_levels()) {
      limit_isa(level);
      const LaneVerdicts found = compare(convex, block, 0xff, 1e-15);
      if (level == Isa::baseline) first = found;
      EXPECT_EQ(found.yes, first.yes);
      EXPECT_EQ(found.open, first.open);
      const LaneVerdicts some = compare(convex, block, 0x35, 1e-15);
      EXPECT_EQ(some.yes, first.yes & 0x35);
      EXPECT_EQ(some.open, first.open & 0x35);
    }
    limit_isa(isa_of_machine());
    open += std::popcount(first.open);
    yes += std::popcount(first.yes);
    all += 8;
  }
  EXPECT_LT(open, all / 100 + 1);
  EXPECT_GT(yes, all / 5);
  EXPECT_LT(yes, all * 4 / 5);
}

// Boxes that are boundless, empty, or turned by what is no rotation.
TEST(ConvexLanes, TheSearchLeavesOutNoLeaf) {
  reference::Random random(6);
  std::size_t visited = 0, all = 0, far = 0;
  for (int i = 0; i < drawn(200, 40); ++i) {
    std::vector<Aabb> boxes;
    for (int k = 0; k < 50; ++k) {
      Aabb& box = boxes.emplace_back();
      const Vec3d at = random.vector(1);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        box.min[axis] = static_cast<float>(at[static_cast<int>(axis)]);
        box.max[axis] = box.min[axis] + static_cast<float>(random.uniform(0, 0.2));
      }
    }
    if (i % 5 == 0) boxes[3].max[1] = std::numeric_limits<float>::infinity();
    if (i % 5 == 1) boxes[4] = Aabb::empty();
    const WideBvh tree = build_wide_bvh(boxes);
    Pose map = {random.rotation(), random.vector(0.5)};
    if (i % 3 == 0) map.rotation *= 1.5;
    const Vec3d half = random.vector(0.2).cwiseAbs();
    const double radius = random.uniform(0, 0.2);
    const SearchBox box = search_box(-half, half, radius, map, 1e-12, 1.5);
    std::vector<bool> seen(tree.leaves());
    WideSearch().run(
        tree, box,
        [](void* to, std::uint32_t leaf) {
          (*static_cast<std::vector<bool>*>(to))[leaf] = true;
          return true;
        },
        &seen);
    for (std::uint32_t leaf = 0; leaf < tree.leaves(); ++leaf) {
      bool near = false;
      for (const std::uint32_t part : tree.leaf(leaf)) {
        // Points of the box that are in reach.
        for (int sample = 0; sample < 8; ++sample) {
          Vec3d point;
          for (int axis = 0; axis < 3; ++axis) {
            const auto k = static_cast<std::size_t>(axis);
            point[axis] =
                random.uniform(boxes[part].min[k],
                               std::max(boxes[part].min[k], std::min(boxes[part].max[k], 3.0F)));
          }
          if (boxes[part].is_empty()) continue;
          const Vec3d there = map(point);
          near |= (there - there.cwiseMax(-half).cwiseMin(half)).norm() <= radius;
        }
      }
      if (near) {
        EXPECT_TRUE(seen[leaf]);
      }
      visited += seen[leaf];
      far += !near;
      ++all;
    }
  }
  EXPECT_LT(visited, all * 9 / 10);
  EXPECT_GT(far, 0u);
}

}  // namespace
}  // namespace touchstone
