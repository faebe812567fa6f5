// Tests of advice.
#include "harness/trade/advice/advise.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>
#include <vector>

#include "algorithms/registry.h"
#include "tests/harness/trade/trade_scenes.h"

namespace touchstone {
namespace {

struct Asked : SmallRequest {
  explicit Asked(const std::string& scene_text) : SmallRequest(scene_text, 1) {
    request.grids[0].boxes = {{}, {trade::BoxChoice::Kind::loose, 0}};
  }
  trade::Advice advice(const trade::ErrorBudget& budget) {
    trade::TradeScene scene(request, representing);
    return trade::advise({request, scene, representing, budget, [](const auto&) {}});
  }
};

const std::string boxes = "generator = \"uniform\"\ncount = 100\noverlaps = 6\nframes = 6\n";

TEST(Advise, MeetsTheBudgetThereAndElsewhere) {
  Asked asked(boxes);
  const trade::Advice exact = asked.advice({.most = 0});
  ASSERT_TRUE(exact.best);
  EXPECT_EQ(exact.best->error, 0);
  EXPECT_THAT(exact.held_out_on, testing::StartsWith("seeds 2 to "));
  ASSERT_GE(exact.held_out.size(), 2u);
  for (const trade::HeldOutGrade& grade : exact.held_out) {
    EXPECT_EQ(grade.error, 0);
    EXPECT_GT(grade.errors.near, 100);
  }
  ASSERT_EQ(exact.evidence.size(), 1u);
  EXPECT_EQ(exact.evidence[0].wrong, 0);
  EXPECT_LE(exact.evidence[0].upper(), trade::zero_is_below);
  EXPECT_FALSE(exact.next_better);  // the best has no error
  EXPECT_LT(exact.within_budget, exact.configurations);

  // The configuration without a narrow phase is the quickest, and wrong; a better one is named.
  const trade::Advice rough = asked.advice({.most = 1, .no_false_negatives = true});
  ASSERT_TRUE(rough.best);
  EXPECT_EQ(rough.best->evaluation.errors.false_negatives, 0);
  EXPECT_EQ(rough.within_budget, rough.configurations);
  EXPECT_TRUE(rough.best->point.configuration.narrow.empty());
  ASSERT_TRUE(rough.next_better);
  EXPECT_LT(rough.next_better->error, rough.best->error);
}

// The request uses the default grids, which have hulls for all kinds of bodies.
TEST(Advise, SpheresNeedNoHullOnTheWay) {
  Asked asked(boxes + "shapes = [\"sphere\"]\n");
  asked.request.grids.clear();
  asked.representing = {represent_no_body, asked.representing.error};
  const trade::Advice advice = asked.advice({.most = 0});
  ASSERT_TRUE(advice.best);
  // Which narrow phase is cheapest is a matter of time, which no test asserts.
  EXPECT_FALSE(advice.best->point.configuration.narrow.empty());
  EXPECT_EQ(advice.best->evaluation.counters.hulls_built, 0);
  EXPECT_EQ(advice.hulls_built, 0);
  EXPECT_GT(advice.configurations, 30u);
  EXPECT_GT(advice.best->evaluation.counters.queries, 50);
  EXPECT_EQ(advice.best->evaluation.counters.witnesses, 0);
}

TEST(Advise, WhatRestsIsNeverUpdated) {
  Asked asked(boxes + "moving = 0\n");
  const trade::Advice advice = asked.advice({.most = 0.02});
  ASSERT_TRUE(advice.best);
  EXPECT_EQ(advice.best->evaluation.counters.updates, 0);
  EXPECT_EQ(advice.best->evaluation.counters.builds, 1);
  EXPECT_GT(advice.best->evaluation.counters.queries, 50);
}

TEST(Advise, DistancesHaveWitnessPoints) {
  Asked asked(boxes);
  asked.request.task = Task::distance;
  asked.request.measure = trade::ErrorMeasure::greatest;
  const trade::Advice advice = asked.advice({.most = 1e-6});
  ASSERT_TRUE(advice.best);
  EXPECT_GT(advice.best->evaluation.counters.witnesses, 50);
}

TEST(Advise, WhatNothingMeetsIsSaid) {
  Asked asked(boxes);
  asked.request.grids[0].narrow = {trade::NarrowChain{}};
  EXPECT_FALSE(asked.advice({.most = 1e-3}).best);
}

const std::string listed = [] {
  std::string text = "frames = 8\n";
  for (int i = 0; i < 30; ++i) {
    text +=
        "[[body]]\nshape = {type = \"box\", half_extents = [1, 1, 1]}\n"
        "translation = [" +
        std::to_string(i) + ".5, 0, 0]\nvelocity = [0, " + std::to_string(i % 5 - 2) +
        ", 0]\nangular_velocity = [0, 0, 1]\n";
  }
  return text;
}();

TEST(Advise, AListedSceneIsHeldOutByWhereItBegins) {
  Asked asked(listed);
  const trade::Advice advice = asked.advice({.most = 0.02});
  ASSERT_TRUE(advice.best);
  EXPECT_THAT(advice.held_out_on, testing::StartsWith("starts 1 to "));
  ASSERT_GE(advice.held_out.size(), 2u);
  for (const trade::HeldOutGrade& grade : advice.held_out) EXPECT_GT(grade.errors.near, 30);
}

TEST(Advise, ScenesAreDrawnUntilTheyShowThatTheBudgetHolds) {
  Asked asked("generator = \"uniform\"\ncount = 30\noverlaps = 4\nmoving = 0\n");
  const trade::Advice advice = asked.advice({.most = 0.01});
  ASSERT_TRUE(advice.best);
  EXPECT_GT(advice.held_out.size(), 2u);
  EXPECT_GE(advice.evidence.at(0).of, 299);
  EXPECT_LE(advice.evidence.at(0).upper(), 0.01);
}

// A ball between the walls of a bracket, which it does not touch.
const std::string bracket = R"(
[[body]]
shape = {type = "compound", parts = [
  {shape = {type = "box", half_extents = [1, 1, 0.1]}},
  {shape = {type = "box", half_extents = [0.1, 1, 1]}, translation = [-0.9, 0, 1]},
  {shape = {type = "box", half_extents = [0.1, 1, 1]}, translation = [0.9, 0, 1]}]}
[[body]]
shape = {type = "sphere", radius = 0.3}
translation = [0, 0, 1]
)";

TEST(Advise, WhatNothingTestsIsNotPromised) {
  for (const double most : {0.0, 1e-3, 0.5}) {
    Asked asked(bracket);
    asked.request.grids = {grid_with("gjk")};
    asked.request.grids[0].narrow.clear();
    asked.request.grids[0].concave = {registry::find<ConcaveEntry>("fused")};
    const trade::Advice advice = asked.advice({.most = most});
    EXPECT_FALSE(advice.best) << most;
    ASSERT_TRUE(advice.untested) << most;
    EXPECT_EQ(advice.untested->error, 0);
    EXPECT_EQ(trade::lack_of(advice.evidence, false),
              "1 pair tests nothing: move the bodies, or give more frames");
  }
}

TEST(Advise, WhatMayMissAContactNeverStandsForABudgetOfZero) {
  using proxies::Form;
  using proxies::Side;
  const trade::ErrorBudget zero{.most = 0}, few{.most = 0.1},
      no_misses{.most = 0.1, .no_false_negatives = true};
  for (const auto& [form, side, misses] :
       {std::tuple(Form::as_given, Side::outer, false), std::tuple(Form::hull, Side::outer, false),
        std::tuple(Form::icosphere, Side::inner, true),
        std::tuple(Form::sphere, Side::nearest, true), std::tuple(Form::mesh, Side::outer, true)}) {
    trade::Representations one;
    one.of[trade::mesh_body] = proxies::Representation{form, side, 1};
    EXPECT_EQ(trade::can_miss(one), misses);
    EXPECT_EQ(trade::may_stand(zero, one), !misses);
    EXPECT_EQ(trade::may_stand(no_misses, one), !misses);
    EXPECT_TRUE(trade::may_stand(few, one));
  }
  EXPECT_FALSE(trade::can_miss({}));
}

// The bounds are those of tables of the binomial distribution.
TEST(Advise, TheGreatestShareIsThatOfClopperAndPearson) {
  EXPECT_NEAR(trade::greatest_share(0, 1), 0.95, 1e-9);
  EXPECT_NEAR(trade::greatest_share(3, 100), 0.0757108, 1e-6);
  EXPECT_LE(trade::greatest_share(0, 59), 0.05);
  EXPECT_GT(trade::greatest_share(0, 58), 0.05);
  EXPECT_LE(trade::greatest_share(0, 2995), 1e-3);
  EXPECT_EQ(trade::greatest_share(0, 0), 1);
  EXPECT_EQ(trade::greatest_share(5, 5), 1);
}

TEST(Advise, EvidenceIsOfWhatIsAskedFor) {
  trade::PointErrors errors;
  errors.near = 900;
  errors.far = 100;
  errors.contacts = 300;
  errors.failed = 1;
  errors.values = 50;
  const auto of = [&](const trade::ErrorBudget& budget, trade::ErrorMeasure measure) {
    std::vector<std::int64_t> counts;
    for (const trade::Evidence& one : trade::evidence_for(budget, measure, errors)) {
      counts.push_back(one.of);
    }
    return counts;
  };
  using testing::ElementsAre;
  EXPECT_THAT(of({}, trade::ErrorMeasure::verdicts), ElementsAre(1000));
  EXPECT_THAT(of({.no_false_negatives = true}, trade::ErrorMeasure::verdicts),
              ElementsAre(1000, 300));
  EXPECT_THAT(of({}, trade::ErrorMeasure::false_negatives), ElementsAre(300));
  EXPECT_THAT(of({}, trade::ErrorMeasure::greatest), ElementsAre(50));
  EXPECT_THAT(of({}, trade::ErrorMeasure::volume), ElementsAre());
  const auto lack =
      trade::lack_of(trade::evidence_for({}, trade::ErrorMeasure::verdicts, errors), true);
  EXPECT_THAT(lack,
              testing::StartsWith("101 of 1000 pairs are wrong, so that at most 12 % of all are"));
}

TEST(Advise, SaysHowFarTheBestLibraryIsBehind) {
  const auto peers = registry::entries<NarrowPhaseEntry>();
  const auto peer = std::ranges::find_if(peers, [](const NarrowPhaseEntry& entry) {
    return entry.info.name == "bullet-gjk-epa" && is_built(entry.info);
  });
  if (peer == peers.end()) GTEST_SKIP() << "Bullet is not built";
  Asked asked("generator = \"uniform\"\ncount = 100\noverlaps = 6\nframes = 6\n");
  asked.request.grids[0].narrow.push_back({&*peer});
  const trade::Advice advice = asked.advice({.most = 0.02});
  ASSERT_TRUE(advice.best);
  EXPECT_GT(advice.with_library, 0u);
  if (!advice.rival) GTEST_SKIP() << "the library is over the budget";
  EXPECT_NE(trade::uses_library(advice.best->point.configuration),
            trade::uses_library(advice.rival->point.configuration));
}

TEST(Advise, ABudgetWithoutMissesCountsUnansweredContacts) {
  trade::Evaluation evaluation;
  evaluation.errors.near = 1000;
  evaluation.errors.contacts = 500;
  const trade::ErrorBudget lenient{.most = 0.1}, strict{.most = 0.1, .no_false_negatives = true};
  const auto both = [&] {
    return std::pair(trade::meets(lenient, trade::ErrorMeasure::verdicts, evaluation, {}),
                     trade::meets(strict, trade::ErrorMeasure::verdicts, evaluation, {}));
  };
  EXPECT_EQ(both(), std::pair(true, true));
  evaluation.errors.bins[0].failed = evaluation.errors.failed = 1;
  EXPECT_EQ(both(), std::pair(true, false));
  evaluation.errors.bins[0].failed = 0;
  evaluation.errors.bins[trade::gap_bins - 1].failed = 1;  // the bin of separated pairs
  EXPECT_EQ(both(), std::pair(true, true));
  evaluation.errors.false_negatives = 1;
  EXPECT_EQ(both(), std::pair(true, false));
  evaluation.errors.false_positives = 200;
  EXPECT_EQ(both(), std::pair(false, false));
  evaluation.state = process::ItemState::crashed;
  evaluation.errors = {};
  EXPECT_EQ(both(), std::pair(false, false));
}

}  // namespace
}  // namespace touchstone
