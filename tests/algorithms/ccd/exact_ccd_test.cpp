// Tests of the oracle for continuous collision: against independent references, each filter against
// none, and under changes that leave the answer as it is.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>

#include "algorithms/oracle/ccd/first_contact.h"
#include "algorithms/registry.h"
#include "harness/families/ccd_families.h"
#include "tests/algorithms/ccd/ccd_reference.h"
#include "tests/algorithms/one_in.h"

namespace touchstone {
namespace {

using families::CcdFamily;
using oracle::ccd::Filters;
using oracle::ccd::Impact;

oracle::ccd::MovingFeatures features_of(FeaturePair pair, const CcdQuery& query) {
  return {pair == FeaturePair::vertex_face ? 1 : 2, query.start, query.end};
}

Impact exact(FeaturePair pair, const CcdQuery& query, Filters filters = Filters::all) {
  return impact_of(features_of(pair, query), filters);
}

template <class Test>
void for_each_query(int count, const Test& test) {
  unsigned seed = 1;
  for (const CcdFamily& family : families::ccd_families()) {
    families::RandomDraws random(seed++);
    for (int i = 0; i < drawn(count, 8); ++i) {
      test(family, family.draw(random), random);
      if (testing::Test::HasFailure()) {
        ADD_FAILURE() << family.name << " " << i;
        return;
      }
    }
  }
}

TEST(ExactCcd, AgreesWithFloatsOfManyBits) {
  int hits = 0, misses = 0;
  for_each_query(120, [&](const CcdFamily& family, const CcdQuery& query, families::RandomDraws&) {
    if (!family.is_small) return;
    const std::optional<double> time = reference::first_contact_of_small(family.pair, query);
    for (const Filters filters : {Filters::all, Filters::fixed_integers, Filters::none}) {
      const Impact impact = exact(family.pair, query, filters);
      ASSERT_EQ(impact.is_hit, time.has_value());
      if (!time) continue;
      EXPECT_LE(impact.free_before, *time + 1e-15);
      EXPECT_GE(impact.contact_by, *time - 1e-15);
    }
    ++(time ? hits : misses);
  });
  EXPECT_GT(hits, drawn(1000, 80));
  EXPECT_GT(misses, drawn(500, 40));
}

TEST(ExactCcd, FiltersChangeNothing) {
  int hits = 0, misses = 0;
  for_each_query(100, [&](const CcdFamily& family, const CcdQuery& drawn_query,
                          families::RandomDraws& random) {
    const double scales[] = {1, 1e-6, 1e6, 0x1p-100, 0x1p-1040, 0x1p900};
    const double scale = scales[random.below(6)];
    const double offset = random.below(3) == 0 ? 1e6 * scale : 0;
    const CcdQuery query = families::changed(drawn_query, scale, offset);
    const Impact truth = exact(family.pair, query, Filters::none);
    for (const Filters filters : {Filters::all, Filters::fixed_integers}) {
      const Impact impact = exact(family.pair, query, filters);
      ASSERT_EQ(impact.is_hit, truth.is_hit) << scale << " " << offset;
      if (!truth.is_hit) continue;
      EXPECT_LE(impact.free_before, truth.contact_by);
      EXPECT_GE(impact.contact_by, truth.free_before);
      EXPECT_LE(impact.contact_by - impact.free_before, 0x1p-40);
    }
    ++(truth.is_hit ? hits : misses);
  });
  EXPECT_GT(hits, drawn(500, 40));
  EXPECT_GT(misses, drawn(500, 40));
}

TEST(ExactCcd, KnowsTheFamiliesByConstruction) {
  for_each_query(100, [](const CcdFamily& family, const CcdQuery& query, families::RandomDraws&) {
    if (family.truth == CcdAnswer::unknown) return;
    for (const double scale : {1.0, 0x1p-20, 0x1p20}) {
      const CcdQuery scaled_query = families::changed(query, scale);
      EXPECT_EQ(exact(family.pair, scaled_query).is_hit, family.truth == CcdAnswer::hit);
    }
  });
}

TEST(ExactCcd, OrderScaleAndDirectionOfTimeChangeNothing) {
  for_each_query(40, [](const CcdFamily& family, const CcdQuery& query, families::RandomDraws&) {
    const Impact whole = exact(family.pair, query);
    CcdQuery other = query;
    for (std::array<Vec3d, 4>* x : {&other.start, &other.end}) {
      if (family.pair == FeaturePair::vertex_face) {
        std::rotate(x->begin() + 1, x->begin() + 2, x->end());
      } else {
        std::rotate(x->begin(), x->begin() + 2, x->end());
      }
    }
    for (const CcdQuery& same : {other, families::changed(query, 0x1p-100)}) {
      const Impact impact = exact(family.pair, same);
      ASSERT_EQ(impact.is_hit, whole.is_hit);
      if (!whole.is_hit) continue;
      EXPECT_NEAR(impact.free_before, whole.free_before, 0x1p-39);
    }
    const CcdQuery reversed = {query.end, query.start};
    EXPECT_EQ(exact(family.pair, reversed).is_hit, whole.is_hit);
    // Where the middle is a double, the halves hit where the whole does.
    CcdQuery first = query, second = query;
    for (std::size_t i = 0; i < 4; ++i) {
      first.end[i] = second.start[i] = 0.5 * query.start[i] + 0.5 * query.end[i];
      if (!(2 * first.end[i] - query.start[i] == query.end[i])) return;
      if (!(2 * first.end[i] - query.end[i] == query.start[i])) return;
    }
    if (!family.is_small) return;
    const Impact early = exact(family.pair, first), late = exact(family.pair, second);
    ASSERT_EQ(early.is_hit || late.is_hit, whole.is_hit);
    if (!whole.is_hit) return;
    const double time = early.is_hit ? early.free_before / 2 : 0.5 + late.free_before / 2;
    EXPECT_NEAR(time, whole.free_before, 0x1p-39);
  });
}

TEST(ExactCcd, OrdersTimesThatDoublesCannotTellApart) {
  // A vertex falls on a resting face from 1 to -s: at 1 / (1 + s).
  const auto falling = [](double s) {
    return CcdQuery{{Vec3d(0, 0, 1), Vec3d(-1, -1, 0), Vec3d(1, -1, 0), Vec3d(0, 1, 0)},
                    {Vec3d(0, 0, -s), Vec3d(-1, -1, 0), Vec3d(1, -1, 0), Vec3d(0, 1, 0)}};
  };
  const auto time = [](const CcdQuery& query) {
    return *oracle::ccd::first_contact(features_of(FeaturePair::vertex_face, query));
  };
  auto a = time(falling(2)), b = time(falling(2 + 0x1p-51)), c = time(falling(2));
  // The same time as another root of another polynomial.
  auto d = time(families::changed(falling(2), 3));
  EXPECT_TRUE(compare(a, b) > 0);
  EXPECT_TRUE(compare(b, a) < 0);
  EXPECT_TRUE(compare(a, c) == 0);
  EXPECT_TRUE(compare(a, d) == 0);
  auto half = time(falling(1)), whole = time(falling(0));
  EXPECT_EQ(half.bounds().low, 0.5);
  EXPECT_EQ(whole.bounds().low, 1);
  EXPECT_TRUE(compare(a, half) < 0);
  EXPECT_TRUE(compare(whole, half) > 0);
}

}  // namespace
}  // namespace touchstone
