// Mid-phases: no pair of boxes that meet is left out, none comes twice, and boxes far apart stay out.
#include <gtest/gtest.h>

#include <set>

#include "algorithms/core/bounds.h"
#include "algorithms/oracle/oracle.h"
#include "tests/algorithms/concave/phases.h"
#include "tests/algorithms/one_in.h"
#include "tests/algorithms/random.h"
#include "tests/algorithms/shapes.h"

namespace touchstone {
namespace {

std::vector<Aabb> any_boxes(reference::Random& random, int count, double size) {
  std::vector<Aabb> boxes;
  for (int i = 0; i < count; ++i) {
    Aabb& box = boxes.emplace_back();
    const Vec3d at = random.vector(1);
    for (int k = 0; k < 3; ++k) {
      const double half = random.below(6) == 0 ? 0 : random.uniform(0, size);
      box.min[k] = static_cast<float>(at[k] - half);
      box.max[k] = static_cast<float>(at[k] + half);
    }
  }
  return boxes;
}

// The verdict of the oracle on two boxes in their bodies' poses.
class BoxTruth {
 public:
  explicit BoxTruth(const std::vector<Aabb>& boxes) {
    for (const Aabb& box : boxes) {
      Hull hull;
      for (int i = 0; i < 8; ++i) {
        const auto end = [&](int k) { return double{(i >> k & 1 ? box.max : box.min)[k]}; };
        hull.vertices.push_back({end(0), end(1), end(2)});
      }
      Shape shape;
      shape.kind = ShapeKind::hull;
      shape.hull = std::make_shared<const Hull>(std::move(hull));
      solids_.emplace_back(shape);
    }
  }
  bool meet(std::uint32_t i, const Pose& pose, const BoxTruth& other, std::uint32_t j,
            const Pose& pose_of_other) {
    return oracle_.verdict(oracle::Body(solids_[i], pose),
                           oracle::Body(other.solids_[j], pose_of_other)) != Answer::separated;
  }

 private:
  std::vector<oracle::Solid> solids_;
  oracle::Oracle oracle_;
};

std::multiset<IndexPair> found_pairs(MidPhase& mid, const Pose& a, const Pose& b) {
  std::multiset<IndexPair> found;
  EXPECT_TRUE(mid.find_pairs(0, a, 1, b, [&](std::span<const IndexPair> pairs) {
    found.insert(pairs.begin(), pairs.end());
    return true;
  }));
  return found;
}

class EveryMidPhase : public testing::TestWithParam<std::string> {
 protected:
  std::unique_ptr<MidPhase> make() const {
    return registry::find<MidPhaseEntry>(GetParam())->make();
  }
};

Pose any_pose(reference::Random& random, int kind) {
  Pose pose = {random.rotation(), random.vector(0.3)};
  if (kind == 1) pose = {Mat3d::Identity(), {0.25, 0.5, 0}};
  if (kind == 2) pose.rotation *= 0.7;
  if (kind == 3) pose.rotation.col(1) += 0.5 * pose.rotation.col(0);
  if (kind == 4) pose.rotation.setZero();
  return pose;
}

TEST_P(EveryMidPhase, LeavesOutNoPairThatMeets) {
  reference::Random random(1);
  std::size_t meeting = 0, given = 0, all = 0;
  for (int i = 0; i < drawn(30, 6); ++i) {
    const auto boxes_a = any_boxes(random, 1 + random.below(40), 0.25);
    const auto boxes_b = any_boxes(random, 1 + random.below(40), 0.25);
    BoxTruth truth_a(boxes_a), truth_b(boxes_b);
    const auto mid = make();
    mid->add(boxes_a);
    mid->add(boxes_b);
    const Pose a = any_pose(random, i % 6), b = any_pose(random, i / 6);
    const auto found = found_pairs(*mid, a, b);
    EXPECT_EQ(std::set<IndexPair>(found.begin(), found.end()).size(), found.size());
    for (std::uint32_t p = 0; p < boxes_a.size(); ++p) {
      for (std::uint32_t q = 0; q < boxes_b.size(); ++q) {
        if (!truth_a.meet(p, a, truth_b, q, b)) continue;
        ++meeting;
        EXPECT_TRUE(found.contains({p, q}));
      }
    }
    given += found.size();
    all += boxes_a.size() * boxes_b.size();
  }
  EXPECT_GT(meeting, one_in == 1 ? 50u : 10u);
  EXPECT_LT(given, all / 2);
}

// Boxes that touch in one point, or are one step of a float apart, with one pose for both bodies.
TEST_P(EveryMidPhase, KeepsTouches) {
  reference::Random random(2);
  for (int i = 0; i < 100; ++i) {
    const Aabb first = {{0, 0, 0}, {1, 2, 3}};
    const Aabb second = {{1, 2, 3}, {4, 5, 6}};
    const auto mid = make();
    mid->add({&first, 1});
    mid->add({&second, 1});
    const Pose pose = {random.rotation(), random.vector(i % 2 == 0 ? 1 : 1e6)};
    EXPECT_EQ(found_pairs(*mid, pose, pose).size(), 1u);
    Pose away = pose;
    away.translation += pose.rotation * Vec3d(0.01, 0, 0);
    if (i % 2 == 0) {
      EXPECT_EQ(found_pairs(*mid, pose, away).size(), 0u);
    }
  }
}

TEST_P(EveryMidPhase, EndsWhereItIsToldTo) {
  reference::Random random(3);
  const auto boxes = any_boxes(random, 100, 0.5);
  const auto mid = make();
  mid->add(boxes);
  mid->add(boxes);
  int calls = 0;
  EXPECT_FALSE(mid->find_pairs(0, {}, 1, {}, [&](std::span<const IndexPair> pairs) {
    EXPECT_FALSE(pairs.empty());
    return ++calls < 3;
  }));
  EXPECT_EQ(calls, 3);
}

TEST_P(EveryMidPhase, FollowsPartsThatMoved) {
  reference::Random random(4);
  const auto first = any_boxes(random, 60, 0.25), moved = any_boxes(random, 60, 0.25);
  const auto other = any_boxes(random, 50, 0.25);
  const auto refitted = make(), built = make();
  refitted->add(first);
  refitted->add(other);
  refitted->refit(0, moved);
  built->add(moved);
  built->add(other);
  const Pose a = any_pose(random, 0), b = any_pose(random, 0);
  const auto found = found_pairs(*refitted, a, b);
  EXPECT_EQ(found, found_pairs(*built, a, b));
  EXPECT_GT(found.size(), 5u);
}

TEST_P(EveryMidPhase, TakesEmptyAndBoundlessBoxes) {
  constexpr float inf = std::numeric_limits<float>::infinity();
  const std::vector<Aabb> odd = {
      Aabb::empty(), {{-inf, -inf, -inf}, {inf, inf, 0}}, {{0, 0, 0}, {1, 1, 1}}, Aabb::empty()};
  const std::vector<Aabb> plain = {{{5, 5, 5}, {6, 6, 6}}, {{0, 0, 0}, {1, 1, 1}}};
  reference::Random random(5);
  for (const Pose& pose : {Pose{}, Pose{random.rotation(), {0, 0, 0}}}) {
    const auto mid = make();
    mid->add(odd);
    mid->add(plain);
    const auto found = found_pairs(*mid, pose, pose);
    EXPECT_TRUE(found.contains({1, 1}));
    EXPECT_TRUE(found.contains({2, 1}));
    EXPECT_FALSE(found.contains({2, 0}));
    for (const IndexPair& pair : found) EXPECT_TRUE(pair.a == 1 || pair.a == 2);
  }
  const auto none = make();
  none->add({});
  none->add(plain);
  EXPECT_TRUE(found_pairs(*none, {}, {}).empty());
}

INSTANTIATE_TEST_SUITE_P(MidPhases, EveryMidPhase, testing::ValuesIn([] {
                           std::vector<std::string> names;
                           for (const MidPhaseEntry& entry : registry::entries<MidPhaseEntry>()) {
                             names.push_back(entry.info.name);
                           }
                           return names;
                         }()),
                         [](const auto& test) {
                           std::string name = test.param;
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace touchstone
