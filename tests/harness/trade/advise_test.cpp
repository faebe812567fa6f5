// Tests of advice.
#include "harness/trade/advice/advise.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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
  EXPECT_EQ(exact.held_out_on, "seeds 2 to 3");
  ASSERT_EQ(exact.held_out.size(), 2u);
  for (const trade::HeldOutGrade& grade : exact.held_out) {
    EXPECT_EQ(grade.error, 0);
    EXPECT_GT(grade.near, 100);
  }
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
  const trade::Advice advice = asked.advice({.most = 0});
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
  const trade::Advice advice = asked.advice({.most = 0});
  ASSERT_TRUE(advice.best);
  EXPECT_EQ(advice.held_out_on, "starts 1 to 2");
  ASSERT_EQ(advice.held_out.size(), 2u);
  for (const trade::HeldOutGrade& grade : advice.held_out) EXPECT_GT(grade.near, 30);
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
