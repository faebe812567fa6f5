// Tests of every algorithm of ours for continuous collision against the exact answer: no contact is
// missed, and what is said to be proven holds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "algorithms/core/isa.h"
#include "algorithms/oracle/ccd/first_contact.h"
#include "algorithms/registry.h"
#include "harness/families/ccd_families.h"
#include "tests/algorithms/ccd/ccd_reference.h"
#include "tests/algorithms/one_in.h"

namespace touchstone {
namespace {

using families::CcdFamily;

std::vector<const CcdEntry*> our_ccds() {
  std::vector<const CcdEntry*> ours;
  for (const CcdEntry& entry : registry::entries<CcdEntry>()) {
    if (entry.info.origin == Origin::ours) ours.push_back(&entry);
  }
  return ours;
}

std::vector<CcdOutcome> solved(const CcdEntry& entry, const CcdSettings& settings, FeaturePair pair,
                               const std::vector<CcdQuery>& queries) {
  std::vector<CcdOutcome> outcomes(queries.size());
  entry.make(settings)->solve(pair, queries, outcomes);
  return outcomes;
}

double reach_of(const CcdQuery& query) {
  double reach = 0;
  for (const std::array<Vec3d, 4>* x : {&query.start, &query.end}) {
    for (const Vec3d& one : *x) reach = std::max(reach, one.cwiseAbs().maxCoeff());
  }
  return reach;
}

struct Counts {
  int hits = 0, misses = 0, unknown = 0;
};

// `contact`: the first contact lies between two times, if there is one.
void expect_right(const CcdQuery& query, FeaturePair pair, const CcdSettings& settings,
                  const CcdOutcome& outcome, Counts& counts) {
  EXPECT_GE(outcome.free_before, 0);
  EXPECT_LE(outcome.free_before, 1);
  switch (outcome.answer) {
    case CcdAnswer::unknown:
      EXPECT_NE(outcome.status, Status::ok);
      ++counts.unknown;
      break;
    case CcdAnswer::miss:
      EXPECT_EQ(outcome.status, Status::ok);
      EXPECT_EQ(outcome.free_before, 1);
      ++counts.misses;
      break;
    case CcdAnswer::hit: {
      EXPECT_EQ(outcome.status, Status::ok);
      EXPECT_LE(outcome.free_before, outcome.toi);
      EXPECT_LE(outcome.toi, outcome.contact_by);
      EXPECT_LE(outcome.contact_by, 1);
      const double distance = reference::distance_at(pair, query, outcome.contact_by);
      EXPECT_LE(distance, settings.separation + settings.tolerance + 1e-15 * reach_of(query));
      ++counts.hits;
      break;
    }
  }
}

TEST(EveryCcd, MissesNoContactInAnyFamilyAtAnyScale) {
  for (const CcdEntry* entry : our_ccds()) {
    Counts counts;
    int contacts = 0, at_size_1 = 0, unknown_at_size_1 = 0;
    unsigned seed = 1;
    for (const CcdFamily& family : families::ccd_families()) {
      families::RandomDraws random(seed++);
      for (const double scale : {1e-6, 1e-2, 1.0, 0x1p-7, 1e3, 1e6}) {
        // Without a tolerance nothing but the bound on the rounding keeps contacts from being missed.
        const CcdSettings settings = {.tolerance = scale == 1e3      ? 0
                                                   : scale == 0x1p-7 ? 1e-10
                                                                     : 1e-6,
                                      .max_iterations = drawn(2000, 200)};
        std::vector<CcdQuery> queries;
        for (int i = 0; i < drawn(24, 6); ++i) {
          const double offset = random.below(6) == 0 ? 1e6 * scale : 0;
          queries.push_back(families::changed(family.draw(random), scale, offset));
        }
        const auto outcomes = solved(*entry, settings, family.pair, queries);
        for (std::size_t i = 0; i < queries.size(); ++i) {
          const CcdOutcome& outcome = outcomes[i];
          expect_right(queries[i], family.pair, settings, outcome, counts);
          const oracle::ccd::Impact truth = oracle::ccd::impact_of(
              {family.pair == FeaturePair::vertex_face ? 1 : 2, queries[i].start, queries[i].end});
          if (truth.is_hit) {
            ++contacts;
            EXPECT_NE(outcome.answer, CcdAnswer::miss);
            EXPECT_LE(outcome.free_before, truth.contact_by);
          }
          if (scale == 1) ++at_size_1;
          unknown_at_size_1 += scale == 1 && outcome.answer == CcdAnswer::unknown ? 1 : 0;
          if (testing::Test::HasFailure()) {
            FAIL() << entry->info.name << ", " << family.name << ", scale " << scale << ", " << i;
          }
        }
      }
    }
    EXPECT_GT(contacts, drawn(2000, 150)) << entry->info.name;
    EXPECT_GT(counts.hits, drawn(2000, 150)) << entry->info.name;
    EXPECT_GT(counts.misses, drawn(500, 40)) << entry->info.name;
    // A sanitizer takes a tenth of the steps, so more is given up.
    EXPECT_LT(unknown_at_size_1, one_in == 1 ? at_size_1 / 8 : at_size_1 / 2) << entry->info.name;
  }
}

TEST(EveryCcd, SeparationCountsAsContact) {
  for (const CcdEntry* entry : our_ccds()) {
    ASSERT_TRUE(entry->separations) << entry->info.name;
    Counts counts;
    int near = 0;
    for (const FeaturePair pair : {FeaturePair::vertex_face, FeaturePair::edge_edge}) {
      families::RandomDraws random(7);
      for (const double separation : {1e-9, 1e-3, 0.3, 100.0}) {
        const CcdSettings settings = {.tolerance = 1e-3, .separation = separation};
        std::vector<CcdQuery> queries(static_cast<std::size_t>(drawn(200, 20)));
        for (CcdQuery& query : queries) {
          for (std::array<Vec3d, 4>* x : {&query.start, &query.end}) {
            for (Vec3d& one : *x) one = random.vector(1);
          }
        }
        const auto outcomes = solved(*entry, settings, pair, queries);
        for (std::size_t i = 0; i < queries.size(); ++i) {
          expect_right(queries[i], pair, settings, outcomes[i], counts);
          for (int k = 0; k <= 64; ++k) {
            if (reference::distance_at(pair, queries[i], k / 64.0) > separation) continue;
            ++near;
            EXPECT_NE(outcomes[i].answer, CcdAnswer::miss);
            EXPECT_LE(outcomes[i].free_before, k / 64.0);
            break;
          }
        }
      }
    }
    EXPECT_GT(near, drawn(300, 30)) << entry->info.name;
    EXPECT_GT(counts.misses, drawn(100, 10)) << entry->info.name;
    EXPECT_LT(counts.unknown, drawn(60, 8)) << entry->info.name;
  }
}

TEST(EveryCcd, OneQueryIsAnsweredLikeMany) {
  for (const CcdEntry* entry : our_ccds()) {
    for (const CcdFamily& family : families::ccd_families()) {
      families::RandomDraws random(3);
      std::vector<CcdQuery> queries;
      for (int i = 0; i < 37; ++i) queries.push_back(family.draw(random));
      const auto together = solved(*entry, {.tolerance = 1e-4}, family.pair, queries);
      EXPECT_TRUE(solved(*entry, {}, family.pair, {}).empty());
      for (std::size_t i = 0; i < queries.size(); i += 12) {
        const auto alone = solved(*entry, {.tolerance = 1e-4}, family.pair, {queries[i]});
        EXPECT_EQ(alone[0].answer, together[i].answer) << entry->info.name << " " << family.name;
        EXPECT_EQ(alone[0].free_before, together[i].free_before);
      }
    }
  }
}

TEST(EveryCcd, AnswersAlikeAtEveryLevel) {
  const Isa before = isa();
  for (const CcdEntry* entry : our_ccds()) {
    for (const CcdFamily& family : families::ccd_families()) {
      families::RandomDraws random(5);
      std::vector<CcdQuery> queries;
      for (int i = 0; i < 20; ++i) queries.push_back(family.draw(random));
      std::vector<CcdOutcome> first;
      for (const Isa level : isa_levels()) {
        limit_isa(level);
        const auto outcomes = solved(*entry, {.tolerance = 1e-4}, family.pair, queries);
        if (first.empty()) first = outcomes;
        for (std::size_t i = 0; i < queries.size(); ++i) {
          EXPECT_EQ(outcomes[i].answer, first[i].answer) << entry->info.name << " " << family.name;
          EXPECT_EQ(outcomes[i].free_before, first[i].free_before);
        }
      }
    }
  }
  limit_isa(before);
}

TEST(EveryCcd, GivingUpIsSaid) {
  // A vertex falls on a face; one step does not find it.
  const CcdQuery query{{Vec3d(0, 0, 1), Vec3d(-1, -1, 0), Vec3d(1, -1, 0.25), Vec3d(0, 1, 0)},
                       {Vec3d(0.5, 0, -1), Vec3d(-1, -1, 0), Vec3d(1, -1, 0), Vec3d(0, 1, 0.5)}};
  for (const CcdEntry* entry : our_ccds()) {
    const auto outcome =
        solved(*entry, {.max_iterations = 1}, FeaturePair::vertex_face, {query}).front();
    EXPECT_EQ(outcome.answer, CcdAnswer::unknown) << entry->info.name;
    EXPECT_EQ(outcome.status, Status::not_converged) << entry->info.name;
    EXPECT_LE(outcome.free_before, 0.6) << entry->info.name;
  }
}

// Edges whose distance has a double root in time: they pass each other at 240 times the tolerance, and get there
// slowly.
TEST(EveryCcd, EdgesThatPassWhereTheirDistanceHasADoubleRoot) {
  const CcdQuery query{{Vec3d(-1, 0, 0.4375), Vec3d(1, 0, -0.4375),
                        Vec3d(-0.125, -1, -0.136962890625), Vec3d(-0.125, 1, -0.136962890625)},
                       {Vec3d(-1, 0, -0.5625), Vec3d(1, 0, 0.5625),
                        Vec3d(0.875, -1, 0.175537109375), Vec3d(0.875, 1, 0.175537109375)}};
  for (const double tolerance : {1e-6, 1e-4}) {
    const CcdSettings settings = {.tolerance = tolerance};
    const auto outcome = solved(*registry::find<CcdEntry>("directional-advancement"), settings,
                                FeaturePair::edge_edge, {query})
                             .front();
    EXPECT_EQ(outcome.status, Status::ok) << tolerance;
    EXPECT_NE(outcome.answer, CcdAnswer::unknown) << tolerance;
    Counts counts;
    expect_right(query, FeaturePair::edge_edge, settings, outcome, counts);
  }
}

}  // namespace
}  // namespace touchstone
