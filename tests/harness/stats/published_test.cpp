// Tests of published claims.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "harness/campaign/campaign.h"
#include "harness/campaign/runner.h"
#include "harness/stats/table_check.h"
#include "tests/harness/input_fault.h"
#include "tests/harness/temporary_folder.h"
#include "tests/project_folder.h"

namespace touchstone::stats {
namespace {

using testing::HasSubstr;

std::filesystem::path campaigns() {
  return std::filesystem::path(touchstone::project_folder) / "datasets/campaigns/published";
}

TEST(Published, IterationsOfGjkOnEllipsoidsAreAsPublished) {
  const campaign::Campaign campaign = campaign::read_campaign(campaigns() / "gjk_iterations.toml");
  const TemporaryFolder folder;
  campaign::run_campaign(campaign, folder.path());
  const stats::Results results = stats::read_results(folder.path());
  EXPECT_EQ(results.sets.size(), 3u);  // there are no broad phases: the scenes list their pairs
  const auto rows = stats::check_published(campaign.published, results, stats::Noise::kept);
  ASSERT_EQ(rows.size(), 6u);
  for (const stats::PublishedRow& row : rows) {
    EXPECT_EQ(row.state, stats::Holds::pass)
        << row.claim << ", " << row.key.scene << ": " << row.published << ", here " << row.here;
  }
  stats::write_published(campaign.published, rows, folder.path());
  EXPECT_THAT(stats::published_text(campaign.published, rows), HasSubstr("GJK++"));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "published.md"));
}

// Results that satisfy the claims.
stats::Results made_up() {
  stats::Results results;
  stats::SampleSet& broad = results.sets.emplace_back();
  broad.key.scene = "uniform";
  for (const auto& [name, seconds] :
       {std::pair{"naive", 3e-3}, std::pair{"sweep-three-axes", 1e-3}}) {
    stats::Contestant& contestant = broad.contestants.emplace_back();
    contestant.label = name;
    for (int square = 0; square < 8; ++square) {
      Sample sample;
      sample.square = square;
      sample.parts.fill(std::numeric_limits<double>::quiet_NaN());
      sample.parts[2] = seconds * (1 + 0.01 * square);
      sample.units = 1;
      contestant.samples.push_back(sample);
    }
  }
  stats::SampleSet& narrow = results.sets.emplace_back();
  narrow.key.scene = "primitives";
  narrow.key.task = "intersect";
  narrow.key.pair_kind = "box-box";
  stats::Contestant& sat = narrow.contestants.emplace_back();
  sat.label = "sat-faces double";
  stats::Check check;
  check.compared = 200;
  check.pair_count = 200;
  check.disagreements = 3;
  sat.checks = {check, check};
  return results;
}

stats::PublishedRow only_row(const stats::PublishedClaim& claim, const stats::Results& results) {
  const auto rows = stats::check_published({.source = "x", .note = "", .claims = {claim}}, results,
                                           stats::Noise::left_out);
  EXPECT_EQ(rows.size(), 1u);
  return rows.at(0);
}

TEST(Published, FasterHoldsFailsOrIsUndecided) {
  stats::Results results = made_up();
  stats::PublishedClaim claim;
  claim.kind = stats::PublishedClaim::Kind::faster;
  claim.algorithm = "sweep-three-axes";
  claim.than = "naive";
  EXPECT_EQ(only_row(claim, results).state, stats::Holds::pass);
  EXPECT_THAT(only_row(claim, results).here, HasSubstr("0.333"));
  std::swap(claim.algorithm, claim.than);
  EXPECT_EQ(only_row(claim, results).state, stats::Holds::fail);
  for (Sample& sample : results.sets[0].contestants[0].samples) sample.noisy = sample.square > 3;
  EXPECT_EQ(only_row(claim, results).state, stats::Holds::undecided);
}

TEST(Published, SufficesCountsWhatIsWrong) {
  stats::Results results = made_up();
  stats::PublishedClaim claim;
  claim.kind = stats::PublishedClaim::Kind::suffices;
  claim.algorithm = "sat-faces double";
  claim.pair_kind = "box-box";
  EXPECT_EQ(only_row(claim, results).state, stats::Holds::fail);
  EXPECT_THAT(only_row(claim, results).here, HasSubstr("6 of 400 pairs wrong (1.5 %)"));
  for (stats::Check& check : results.sets[1].contestants[0].checks) check.disagreements = 0;
  EXPECT_EQ(only_row(claim, results).state, stats::Holds::pass);
  claim.pair_kind = "sphere-sphere";
  EXPECT_EQ(only_row(claim, results).state, stats::Holds::undecided);
  EXPECT_EQ(only_row(claim, results).here, "was not run");
}

TEST(Published, BadClaimsAreRefusedWithTheirLine) {
  const TemporaryFolder folder;
  folder.write("s.toml", "generator = \"uniform\"\n");
  const auto refusal = [&](const std::string& text) {
    return input_fault(
        [&] { campaign::read_campaign(folder.write("c.toml", "scenes = \"s.toml\"\n" + text)); });
  };
  EXPECT_EQ(refusal("[published]\nsource = \"x\"\n"), "");
  EXPECT_THAT(refusal("[published]\nnote = \"x\"\n"), HasSubstr("source"));
  EXPECT_THAT(refusal("[published]\nsource = \"x\"\nsauce = 1\n"), HasSubstr("c.toml:4"));
  EXPECT_THAT(refusal("[published]\nsource = \"x\"\n[[published.faster]]\nalgorithm = \"a\"\n"),
              HasSubstr("than"));
  EXPECT_THAT(refusal("[published]\nsource = \"x\"\n[[published.iterations]]\nalgorithm = \"a\"\n"
                      "mean = 0\ndeviation = 1\n"),
              HasSubstr("c.toml:6"));
  EXPECT_THAT(refusal("duality_gap = 1e-8\nnarrow = \"mpr\"\n"), HasSubstr("gjk, gjk-nesterov"));
  EXPECT_THAT(refusal("duality_gap = -1\nnarrow = \"gjk\"\n"), HasSubstr("c.toml:2"));
}

}  // namespace
}  // namespace touchstone::stats
