// Triangle pairs against the truth in integers, family by family and form by form.
#include <gtest/gtest.h>

#include "algorithms/core/mesh/common_frame.h"
#include "algorithms/kernels/triangles/exact_triangles.h"
#include "algorithms/kernels/triangles/moved_block.h"
#include "algorithms/kernels/triangles/triangle_signs.h"
#include "algorithms/registry.h"
#include "harness/families/triangle_pairs.h"
#include "tests/algorithms/concave/phases.h"
#include "tests/algorithms/concave/triangle_truth.h"
#include "tests/algorithms/one_in.h"

namespace touchstone {
namespace {

using families::TriangleFamily;
using families::TriangleForm;
using families::TrianglePair;

// Calls `check` with pairs of every family in every form, and their truths.
template <class Check>
void for_each_pair(int count, const Check& check) {
  unsigned seed = 1;
  for (const TriangleFamily& family : families::triangle_families()) {
    int hits = 0, misses = 0;
    for (const TriangleForm form : families::all_triangle_forms) {
      SCOPED_TRACE(family.name + ", form " + std::to_string(static_cast<int>(form)));
      families::RandomDraws random(seed++);
      for (int i = 0; i < count; ++i) {
        const TrianglePair pair = in_form(family.draw(random), form, random);
        const bool truth = reference::triangles_meet(pair);
        ++(truth ? hits : misses);
        check(pair, truth);
        if (testing::Test::HasFailure()) return;
      }
    }
    EXPECT_GT(hits, 0) << family.name;
    EXPECT_TRUE(misses > 0 || family.only_hits) << family.name;
  }
}

TriangleBlock block_of(const std::array<Vec3d, 3>& corners, const Pose& pose) {
  TriangleBlock block, moved;
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      block.at[3 * k + axis].fill(corners[k][static_cast<int>(axis)]);
    }
  }
  move(block, pose, moved);
  return moved;
}

double reach_of(const std::array<Vec3d, 3>& corners) {
  double reach = 0;
  for (const Vec3d& corner : corners) reach = std::max(reach, corner.cwiseAbs().maxCoeff());
  return reach;
}

TEST(TrianglePairs, IntegersAreRight) {
  for_each_pair(drawn(80, 8), [](const TrianglePair& pair, bool truth) {
    EXPECT_EQ(share_a_point(pair.a, pair.pose_a, pair.b, pair.pose_b), truth);
    EXPECT_EQ(share_a_point(pair.b, pair.pose_b, pair.a, pair.pose_a), truth);
  });
}

TEST(TrianglePairs, SignsAreRightWhereTheyDecide) {
  for (const Isa level : isa_levels()) {
    limit_isa(level);
    int decided = 0, open = 0, lanes_differ = 0;
    for_each_pair(drawn(32, 4), [&](const TrianglePair& pair, bool truth) {
      const CommonFrame frame =
          common_frame(pair.pose_a, reach_of(pair.a), pair.pose_b, reach_of(pair.b));
      ASSERT_TRUE(frame.is_of_a);
      BlockSigns signs;
      compare(block_of(pair.a, {}), 0xff, block_of(pair.b, frame.b), 0xff, frame.error, signs);
      for (const unsigned bits : signs.yes) lanes_differ += bits != 0 && bits != 0xff;
      for (const unsigned bits : signs.open) lanes_differ += bits != 0 && bits != 0xff;
      if (signs.open[0] != 0) {
        ++open;
        return;
      }
      ++decided;
      EXPECT_EQ(signs.yes[0] != 0, truth);
    });
    EXPECT_EQ(lanes_differ, 0);
    EXPECT_GT(decided, 500 / one_in);
    EXPECT_GT(open, 500 / one_in);
  }
  limit_isa(isa_of_machine());
}

TEST(TrianglePairs, GenericPairsAreDecidedBySigns) {
  families::RandomDraws random(5);
  int open = 0, hits = 0;
  const int count = drawn(20000, 2000);
  for (int i = 0; i < count; ++i) {
    const TrianglePair pair =
        in_form(families::triangle_families()[0].draw(random), TriangleForm::two_poses, random);
    const CommonFrame frame =
        common_frame(pair.pose_a, reach_of(pair.a), pair.pose_b, reach_of(pair.b));
    BlockSigns signs;
    compare(block_of(pair.a, {}), 1, block_of(pair.b, frame.b), 1, frame.error, signs);
    open += signs.open[0] != 0;
    hits += signs.yes[0] != 0;
  }
  EXPECT_LE(open, 2);
  EXPECT_GT(hits, count / 20);
  EXPECT_LT(hits, count / 2);
}

TEST(TrianglePairs, EveryPhaseIsRight) {
  for (const std::string& name : reference::concave_names()) {
    SCOPED_TRACE(name);
    int wrong = 0, asked = 0;
    const bool approximate = registry::find<ConcaveEntry>(name)->approximate;
    for_each_pair(7, [&](const TrianglePair& pair, bool truth) {
      const std::array<ConcaveBody, 2> bodies = {reference::mesh_of({pair.a}),
                                                 reference::mesh_of({pair.b})};
      const reference::Answered answered =
          reference::ask(name, ConcaveTask::contacts, bodies, pair.pose_a, pair.pose_b);
      ++asked;
      wrong += answered.meets() != truth;
      EXPECT_EQ(answered.outcome.status, approximate ? Status::not_reported : Status::ok);
      if (approximate) return;
      EXPECT_EQ(answered.meets(), truth);
      EXPECT_EQ(answered.pairs.size(), truth ? 1u : 0u);
    });
    // In doubles, contacts come out either way; most others do not.
    EXPECT_LT(wrong, approximate ? asked / 2 : 1);
  }
}

}  // namespace
}  // namespace touchstone
