// Tests of the comparison of two results.
#include "harness/stats/comparison.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/harness/stats/sample_file.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone::stats {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class Comparison : public testing::Test {
 protected:
  stats::Results results(const FakeRun& run) {
    return stats::read_results(run.write(folder_.path() / std::to_string(next_++)));
  }
  TemporaryFolder folder_;
  int next_ = 0;
};

stats::ComparedCell cell(double low, double high, double p) {
  stats::ComparedCell c;
  c.ratio = {(low + high) / 2, low, high, 12};
  c.p_corrected = p;
  return c;
}

TEST(VerdictOf, IntervalAgainstTheBand) {
  EXPECT_EQ(stats::verdict(cell(1.04, 1.06, 0.001), 0.03), Verdict::slower);
  EXPECT_EQ(stats::verdict(cell(1.04, 1.06, 0.2), 0.03), Verdict::undecided);
  EXPECT_EQ(stats::verdict(cell(1.02, 1.06, 0.001), 0.03), Verdict::undecided);
  EXPECT_EQ(stats::verdict(cell(0.98, 1.02, 0.5), 0.03), Verdict::same);
  EXPECT_EQ(stats::verdict(cell(1.01, 1.02, 0.001), 0.03), Verdict::same);
  EXPECT_EQ(stats::verdict(cell(0.90, 0.96, 0.001), 0.03), Verdict::faster);
  EXPECT_EQ(stats::verdict(cell(0.90, 1.02, 0.5), 0.03), Verdict::not_slower);
  EXPECT_EQ(stats::verdict(cell(0.90, 1.20, 0.5), 0.03), Verdict::undecided);
  EXPECT_EQ(stats::verdict(cell(0.0 / 0.0, 0.0 / 0.0, 1), 0.03), Verdict::undecided);
}

TEST_F(Comparison, TwinsAreTheSame) {
  FakeRun run = fake_run();
  run.square_spread = 0.005;
  const stats::Results a = results(run);
  run.seed = 2;
  const stats::Results b = results(run);
  EXPECT_THAT(stats::obstacles(a, b, true), IsEmpty());
  EXPECT_THAT(stats::changed_answers(a, b, stats::Compared::answers_and_work), IsEmpty());
  EXPECT_THAT(stats::remarks(a, b), IsEmpty());
  const auto cells = compare(a, b, stats::Noise::left_out);
  ASSERT_EQ(cells.size(), 5u);
  for (const stats::ComparedCell& c : cells)
    EXPECT_EQ(stats::verdict(c, 0.03), Verdict::same) << c.label;
}

TEST_F(Comparison, FivePercentAreFoundAndOnlyWhereTheyAre) {
  FakeRun run = fake_run();
  run.square_spread = 0.005;
  const stats::Results a = results(run);
  run.seed = 2;
  run.blocks[0].contestants[1].seconds *= 1.05;
  const auto cells = compare(a, results(run), stats::Noise::left_out);
  ASSERT_EQ(cells.size(), 5u);
  EXPECT_NEAR(cells[1].ratio.median, 1.05, 0.01);
  EXPECT_LT(cells[1].p_corrected, 0.001);
  for (const stats::ComparedCell& c : cells) {
    EXPECT_EQ(stats::verdict(c, 0.03), c.label == "uniform-grid" ? Verdict::slower : Verdict::same);
  }
}

TEST_F(Comparison, InterleavedRunsCancelWhatTheyShare) {
  std::vector<stats::Results> a, b;
  for (int i = 0; i < 8; ++i) {
    FakeRun run = fake_run();
    run.seed = static_cast<std::uint64_t>(i) + 10;
    // The machine becomes slower from run to run, for both.
    for (FakeBlock& block : run.blocks) {
      for (FakeContestant& c : block.contestants) c.seconds *= 1 + 0.1 * i;
    }
    run.square_spread = 0.005;
    a.push_back(results(run));
    run.seed += 100;
    run.blocks[1].contestants[0].seconds *= 1.02;
    b.push_back(results(run));
  }
  const auto cells = stats::compare_runs(a, b, stats::Noise::left_out);
  ASSERT_EQ(cells.size(), 5u);
  EXPECT_EQ(cells[3].label, "gjk double");
  EXPECT_NEAR(cells[3].ratio.median, 1.02, 0.005);
  EXPECT_LT(cells[3].ratio.high, 1.03);
  EXPECT_GT(cells[3].ratio.low, 1.01);
  for (const stats::ComparedCell& c : cells)
    EXPECT_EQ(stats::verdict(c, 0.03), Verdict::same) << c.label;
}

TEST_F(Comparison, SaysWhatIsNotComparable) {
  const stats::Results a = results(fake_run());
  FakeRun other = fake_run();
  other.machine["processor"] = "Another CPU";
  EXPECT_THAT(stats::obstacles(a, results(other), true),
              ElementsAre("processor: 'Test CPU' in A, 'Another CPU' in B"));
  EXPECT_THAT(stats::obstacles(a, results(other), false), IsEmpty());
  other = fake_run();
  other.isa = "avx512";
  EXPECT_THAT(stats::obstacles(a, results(other), true),
              ElementsAre("vector instructions: avx2 in A, avx512 in B"));
  other = fake_run();
  other.blocks[0].scene_hash = "ffffffffffffffff";
  EXPECT_THAT(stats::obstacles(a, results(other), true),
              ElementsAre("scene uniform with 1000 bodies: hash 0123456789abcdef in A, "
                          "ffffffffffffffff in B"));
  other = fake_run();
  other.blocks[0].threads = 1;
  EXPECT_THAT(stats::obstacles(a, results(other), true),
              ElementsAre("settings: uniform, 1000 bodies, tight boxes, 2 threads, broad phases "
                          "is not in B"));
  other = fake_run();
  other.blocks[1].contestants.pop_back();
  EXPECT_THAT(stats::obstacles(a, results(other), true),
              ElementsAre(HasSubstr("settings: mpr double in uniform")));
  other = fake_run();
  other.machine["compiler"] = "GNU 13";
  other.blocks[1].contestants.push_back({"sat", 1e-7});
  const stats::Results b = results(other);
  EXPECT_THAT(stats::obstacles(a, b, true), IsEmpty());
  EXPECT_THAT(stats::remarks(a, b), ElementsAre("compiler: 'GNU 12' in A, 'GNU 13' in B",
                                                HasSubstr("only B has sat double in uniform")));
}

TEST_F(Comparison, ChangedAnswersAndNewFailuresAreTold) {
  const stats::Results a = results(fake_run());
  FakeRun other = fake_run();
  other.blocks[0].contestants[1].pair_hash = "00000000000000bb";
  EXPECT_THAT(stats::changed_answers(a, results(other), stats::Compared::answers),
              ElementsAre("uniform-grid in uniform, 1000 bodies, tight boxes, 2 threads, broad "
                          "phases, frame 0: pair hash 00000000000000aa in A, 00000000000000bb in "
                          "B"));
  other = fake_run();
  other.blocks[1].contestants[1].status = "crashed";
  EXPECT_THAT(stats::changed_answers(a, results(other), stats::Compared::answers),
              ElementsAre(HasSubstr("mpr double in uniform, 1000 bodies, tight boxes, 2 threads, "
                                    "distance box-sphere: crashed in B")));
}

}  // namespace
}  // namespace touchstone::stats
