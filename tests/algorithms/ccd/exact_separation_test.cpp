// Tests of the oracle for continuous collision with a separation: against distances at many times, against
// contacts, and where the answer is known.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "algorithms/oracle/ccd/first_within.h"
#include "algorithms/registry.h"
#include "harness/families/ccd_families.h"
#include "tests/algorithms/ccd/ccd_reference.h"
#include "tests/algorithms/one_in.h"

namespace touchstone {
namespace {

using families::CcdFamily;
using oracle::ccd::Impact;

Impact within(FeaturePair pair, const CcdQuery& query, double separation) {
  const int first_count = pair == FeaturePair::vertex_face ? 1 : 2;
  return oracle::ccd::impact_within({first_count, query.start, query.end}, separation);
}
Impact by_roots(FeaturePair pair, const CcdQuery& query, double separation) {
  const int first_count = pair == FeaturePair::vertex_face ? 1 : 2;
  auto time = oracle::ccd::first_within({first_count, query.start, query.end}, separation);
  if (!time) return {};
  const oracle::ccd::TimeBounds bounds = time->bounds();
  return {true, bounds.low, bounds.high};
}

// Before the time the features are further apart, then they are as near as the separation.
TEST(ExactSeparation, AgreesWithDistancesAtManyTimes) {
  int hits = 0, misses = 0, starts = 0;
  unsigned seed = 1;
  for (const CcdFamily& family : families::ccd_families()) {
    families::RandomDraws random(seed++);
    for (int i = 0; i < drawn(16, 2); ++i) {
      const CcdQuery query = family.draw(random);
      const double separation = std::array{0x1p-20, 0.01, 0.25, 1.0}[random.below(4)];
      const Impact impact = within(family.pair, query, separation);
      const double reach = 1e-12 * (1 + separation);
      for (int k = 0; k <= 32; ++k) {
        const double time = impact.is_hit ? impact.free_before * k / 33.0 : k / 32.0;
        if (impact.is_hit && impact.free_before == 0) break;
        EXPECT_GE(reference::distance_at(family.pair, query, time), separation - reach)
            << family.name << " " << i << " " << time;
      }
      if (impact.is_hit) {
        EXPECT_LE(impact.contact_by - impact.free_before, 0x1p-40);
        const double then = reference::distance_at(family.pair, query, impact.contact_by);
        EXPECT_LE(then, separation + 1e-9) << family.name << " " << i;
        ++(impact.contact_by == 0 ? starts : hits);
      } else {
        ++misses;
      }
    }
  }
  EXPECT_GT(hits, drawn(60, 6));
  EXPECT_GT(misses, drawn(60, 6));
  EXPECT_GT(starts, drawn(10, 1));
}

// Distances of no length are contacts, which other polynomials tell.
TEST(ExactSeparation, OfNothingIsContact) {
  int hits = 0, misses = 0;
  unsigned seed = 1;
  for (const CcdFamily& family : families::ccd_families()) {
    families::RandomDraws random(seed++);
    for (int i = 0; i < drawn(12, 2); ++i) {
      const CcdQuery query = family.draw(random);
      const int first_count = family.pair == FeaturePair::vertex_face ? 1 : 2;
      const Impact contact = oracle::ccd::impact_of({first_count, query.start, query.end});
      const Impact impact = by_roots(family.pair, query, 0);
      ASSERT_EQ(impact.is_hit, contact.is_hit) << family.name << " " << i;
      if (contact.is_hit) {
        EXPECT_LE(impact.free_before, contact.contact_by) << family.name << " " << i;
        EXPECT_GE(impact.contact_by, contact.free_before) << family.name << " " << i;
      }
      ++(contact.is_hit ? hits : misses);
    }
  }
  EXPECT_GT(hits, drawn(60, 6));
  EXPECT_GT(misses, drawn(60, 6));
}

// A vertex falls on a resting face from height 2 to 0.
CcdQuery falling() {
  const Vec3d p(-1, -1, 0), q(1, -1, 0), r(0, 1, 0);
  return {{Vec3d(0, 0, 2), p, q, r}, {Vec3d(0, 0, 0), p, q, r}};
}

TEST(ExactSeparation, IsExactWhereDistancesAreReachedInOneInstant) {
  const auto time = [](double separation) {
    return within(FeaturePair::vertex_face, falling(), separation).free_before;
  };
  EXPECT_EQ(time(0.5), 0.75);
  EXPECT_EQ(time(2), 0);
  EXPECT_EQ(time(0x1p-1074), 1 - 0x1p-53);
  // Two vertices that pass each other at a distance of exactly 1, at half of the time.
  const CcdQuery edges{{Vec3d(-1, 1, 0), Vec3d(-1, 2, 0), Vec3d(1, 0, 0), Vec3d(1, -1, 0)},
                       {Vec3d(1, 1, 0), Vec3d(1, 2, 0), Vec3d(-1, 0, 0), Vec3d(-1, -1, 0)}};
  const Impact touch = within(FeaturePair::edge_edge, edges, 1);
  EXPECT_TRUE(touch.is_hit);
  EXPECT_EQ(touch.free_before, 0.5);
  EXPECT_EQ(touch.contact_by, 0.5);
  EXPECT_FALSE(within(FeaturePair::edge_edge, edges, 1 - 0x1p-53).is_hit);
}

// Crossed edges keep the height 1, and come over each other at half of the time.
TEST(ExactSeparation, BeginsWhereNearestPointsEnterTheParts) {
  const CcdQuery sliding{{Vec3d(-1, 0, 0), Vec3d(1, 0, 0), Vec3d(2, -1, 1), Vec3d(2, 1, 1)},
                         {Vec3d(-1, 0, 0), Vec3d(1, 0, 0), Vec3d(0, -1, 1), Vec3d(0, 1, 1)}};
  const Impact impact = within(FeaturePair::edge_edge, sliding, 1);
  EXPECT_TRUE(impact.is_hit);
  EXPECT_EQ(impact.free_before, 0.5);
  EXPECT_FALSE(within(FeaturePair::edge_edge, sliding, 1 - 0x1p-53).is_hit);
  // Nothing moves: at the start or never.
  const CcdQuery still{sliding.end, sliding.end};
  EXPECT_EQ(within(FeaturePair::edge_edge, still, 1).contact_by, 0);
  EXPECT_TRUE(within(FeaturePair::edge_edge, still, 1).is_hit);
  EXPECT_FALSE(within(FeaturePair::edge_edge, still, 1 - 0x1p-53).is_hit);
}

TEST(ExactSeparation, HoldsForPointsAndSegmentsInPlaceOfFaces) {
  // A face that is a point, a face that is a segment, and edges that are points.
  CcdQuery query = falling();
  for (std::array<Vec3d, 4>* x : {&query.start, &query.end})
    (*x)[1] = (*x)[2] = (*x)[3] = Vec3d(0, 0, -1);
  EXPECT_EQ(within(FeaturePair::vertex_face, query, 2).free_before, 0.5);
  EXPECT_EQ(within(FeaturePair::edge_edge, query, 1.5).is_hit, true);
  for (std::array<Vec3d, 4>* x : {&query.start, &query.end}) {
    (*x)[1] = Vec3d(-1, 0, -1);
    (*x)[2] = Vec3d(0.5, 0, -1);
    (*x)[3] = Vec3d(1, 0, -1);
  }
  EXPECT_EQ(within(FeaturePair::vertex_face, query, 2).free_before, 0.5);
  EXPECT_FALSE(within(FeaturePair::vertex_face, query, 1 - 0x1p-53).is_hit);
}

TEST(ExactSeparation, ScaleAndDirectionOfTimeChangeNothing) {
  families::RandomDraws random(3);
  int hits = 0, misses = 0;
  for (int i = 0; i < drawn(100, 8); ++i) {
    const FeaturePair pair = i % 2 == 0 ? FeaturePair::vertex_face : FeaturePair::edge_edge;
    const CcdQuery query = families::motion_query(pair, 2, random);
    CcdQuery away = query;
    const Vec3d shift = random.vector(2);
    const auto first_count = pair == FeaturePair::vertex_face ? 1U : 2U;
    for (std::size_t k = 0; k < first_count; ++k) {
      away.start[k] += shift;
      away.end[k] += shift;
    }
    const Impact impact = within(pair, away, 0.25);
    for (const double scale : {0x1p-60, 0x1p300}) {
      const Impact same = within(pair, families::changed(away, scale), 0.25 * scale);
      EXPECT_EQ(same.is_hit, impact.is_hit);
      EXPECT_EQ(same.free_before, impact.free_before);
    }
    EXPECT_EQ(within(pair, {away.end, away.start}, 0.25).is_hit, impact.is_hit);
    ++(impact.is_hit ? hits : misses);
  }
  EXPECT_GT(hits, drawn(20, 1));
  EXPECT_GT(misses, drawn(20, 1));
}

TEST(ExactSeparation, AnswersTheContract) {
  const auto algorithm = registry::find<CcdEntry>("exact")->make({.separation = 0.5});
  const CcdQuery query = falling();
  CcdOutcome outcome;
  algorithm->solve(FeaturePair::vertex_face, {&query, 1}, {&outcome, 1});
  EXPECT_EQ(outcome.status, Status::ok);
  EXPECT_EQ(outcome.answer, CcdAnswer::hit);
  EXPECT_EQ(outcome.toi, 0.75);
}

}  // namespace
}  // namespace touchstone
