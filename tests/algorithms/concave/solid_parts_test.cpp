// Solid meshes among the parts of compounds: every phase against the oracle, and against the mesh alone.
#include <gtest/gtest.h>

#include "tests/algorithms/concave/agreed.h"
#include "tests/algorithms/concave/meshes.h"
#include "tests/algorithms/one_in.h"
#include "tests/algorithms/random.h"

namespace touchstone {
namespace {

using reference::add_surface;
using reference::agreed;
using reference::Answered;
using reference::ask;
using reference::body_of;
using reference::moved_by;

// A ball, and a mesh three metres away from it.
ConcaveBody ball_and(TriangleMesh mesh) {
  ConcaveBody body = body_of(reference::make_sphere(0.25));
  add_surface(body, std::move(mesh), moved_by({3, 0, 0}));
  return body;
}

ConcaveBody shells() {
  ConcaveBody body = body_of(reference::make_sphere(0.25), moved_by({0, 5, 0}));
  add_surface(body, reference::box_mesh(0.25, 0.25, 0.25), {});
  return body;
}

TEST(SolidParts, WhatIsInsideMeetsThem) {
  reference::Random random(1);
  const Pose turned = {random.rotation(), random.vector(2)};
  for (const bool solid : {false, true}) {
    const ConcaveBody large = ball_and(reference::box_mesh(1, 1, 1, solid));
    for (const ConcaveBody& inner :
         {body_of(reference::box_mesh(0.25, 0.25, 0.25)), body_of(reference::make_sphere(0.5)),
          body_of(reference::make_box(0.5, 0.25, 0.25)), shells()}) {
      for (const Pose& pose : {Pose{}, turned}) {
        const Pose inside = {pose.rotation, pose(Vec3d(3, 0, 0))};
        const Answered answered = agreed({large, inner}, pose, inside);
        EXPECT_EQ(answered.meets(), solid);
        EXPECT_TRUE(answered.pairs.empty());
        EXPECT_EQ(agreed({inner, large}, inside, pose).meets(), solid);
        EXPECT_FALSE(agreed({large, inner}, pose, moved_by({9, 9, 9})).meets());
      }
    }
  }
}

TEST(SolidParts, LieInsideOfOthersToo) {
  const ConcaveBody small = ball_and(reference::box_mesh(0.25, 0.25, 0.25));
  for (const bool solid : {false, true}) {
    // The mesh of the small compound is inside of the large one's, and its ball is outside.
    ConcaveBody large;
    add_surface(large, reference::box_mesh(1, 1, 1, solid), {});
    EXPECT_EQ(agreed({small, large}, {}, moved_by({3, 0, 0})).meets(), solid);
    EXPECT_EQ(agreed({large, small}, moved_by({3, 0, 0}), {}).meets(), solid);
    EXPECT_EQ(agreed({small, body_of(reference::box_mesh(1, 1, 1, solid))}, {}, moved_by({3, 0, 0}))
                  .meets(),
              solid);
    EXPECT_FALSE(agreed({small, large}, {}, moved_by({3, 5, 0})).meets());
  }
}

TEST(SolidParts, HalfSpacesMeetTheirSurfaces) {
  const ConcaveBody body = ball_and(reference::box_mesh(1, 1, 1, true));
  Shape floor;
  floor.kind = ShapeKind::halfspace;
  EXPECT_TRUE(agreed({body, body_of(floor)}, moved_by({0, 0, -9}), {}).meets());
  EXPECT_TRUE(agreed({body, body_of(floor)}, moved_by({0, 0, 1}), {}).meets());
  EXPECT_FALSE(agreed({body, body_of(floor)}, moved_by({0, 0, 1.25}), {}).meets());
}

// At places on a grid, where nothing is rounded, a compound of one solid mesh is that mesh.
TEST(SolidParts, AnswerAsTheMeshAloneDoes) {
  reference::Random random(2);
  int hits = 0, misses = 0, held = 0;
  const int count = drawn(90, 40);
  for (int i = 0; i < count; ++i) {
    const TriangleMesh mesh =
        i % 2 == 0 ? reference::torus(8, 4, 1, 0.5, true) : reference::box_mesh(1, 1, 1, true);
    const auto quarter = [&] { return random.below(13) / 4.0 - 1.5; };
    const Vec3d at(quarter(), quarter(), quarter());
    ConcaveBody compound;
    add_surface(compound, mesh, moved_by(at));
    const ConcaveBody other = i % 3 == 0   ? body_of(reference::make_sphere(0.125))
                              : i % 3 == 1 ? body_of(reference::box_mesh(0.125, 0.25, 0.125))
                                           : shells();
    const Vec3d there(quarter(), quarter(), quarter());
    const Pose pose = {i % 5 == 0 ? random.rotation() : Mat3d::Identity(),
                       i % 4 == 0 ? there : Vec3d(at + there / 2)};
    const Answered parts = agreed({compound, other}, {}, pose);
    const Answered alone =
        ask("exact", ConcaveTask::contacts, {body_of(mesh), other}, moved_by(at), pose);
    EXPECT_EQ(parts.outcome.answer, alone.outcome.answer);
    EXPECT_EQ(parts.pairs, alone.pairs);
    hits += parts.meets();
    held += parts.meets() && parts.pairs.empty();
    misses += parts.outcome.answer == Answer::separated;
    if (parts.meets() || i % 4 != 0) continue;
    const Outcome exact =
        ask("exact", ConcaveTask::distance, {body_of(mesh), other}, moved_by(at), pose).outcome;
    const Outcome found = ask("fused", ConcaveTask::distance, {compound, other}, {}, pose).outcome;
    EXPECT_EQ(found.answer, Answer::separated);
    EXPECT_LE(found.lower, exact.upper);
    EXPECT_GE(found.upper, exact.lower);
    EXPECT_NEAR(found.distance, exact.distance, 1e-12);
  }
  EXPECT_GT(hits, count / 5);
  EXPECT_GT(held, count / 20);
  EXPECT_GT(misses, count / 5);
}

// Within turned compounds places are rounded: what is well inside meets the solid all the same.
TEST(SolidParts, RoundedPlacesHideWhatIsNearTheSurfaceAlone) {
  reference::Random random(3);
  int open = 0, inside = 0, outside = 0;
  const int count = drawn(60, 30);
  for (int i = 0; i < count; ++i) {
    const Pose place = {random.rotation(), random.vector(1)},
               body = {random.rotation(), random.vector(1)};
    ConcaveBody compound;
    add_surface(compound, reference::box_mesh(1, 1, 1, true), place, 1e-16);
    // A point at the middle of a face, inside or outside.
    const double height = i % 3 == 0 ? 1 : i % 3 == 1 ? 1 - 1e-9 : 1 + 1e-9;
    Vec3d point = body(place(Vec3d(0.25, 0, height)));
    const Answered answered =
        agreed({compound, body_of(reference::make_sphere(0))}, body, moved_by(point));
    const Answer expected = i % 3 == 0   ? Answer::unknown
                            : i % 3 == 1 ? Answer::overlapping
                                         : Answer::separated;
    EXPECT_EQ(answered.outcome.answer, expected);
    EXPECT_EQ(answered.outcome.status, i % 3 == 0 ? Status::degenerate : Status::ok);
    open += answered.outcome.answer == Answer::unknown;
    inside += answered.meets();
    outside += answered.outcome.answer == Answer::separated;
  }
  EXPECT_GT(open, 0);
  EXPECT_GT(inside, 0);
  EXPECT_GT(outside, 0);
}

TEST(SolidParts, AreNotGivenToLibrariesThatTakeSurfaces) {
  const ConcaveBody surface = ball_and(reference::box_mesh(1, 1, 1)),
                    solid = ball_and(reference::box_mesh(1, 1, 1, true)),
                    mesh = body_of(reference::torus(8, 4, 1, 0.25));
  EXPECT_FALSE(surface.has_inside());
  EXPECT_TRUE(solid.has_inside());
  int asked = 0;
  for (const ConcaveEntry& entry : registry::entries<ConcaveEntry>()) {
    if (entry.info.origin != Origin::peer || entry.supports == nullptr) continue;
    ++asked;
    EXPECT_FALSE(entry.supports(solid, mesh)) << entry.info.name;
    EXPECT_FALSE(entry.supports(mesh, solid)) << entry.info.name;
  }
  EXPECT_GT(asked, 0);
}

}  // namespace
}  // namespace touchstone
