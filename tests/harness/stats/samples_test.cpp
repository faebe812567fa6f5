// Tests of the reading of samples.
#include "harness/stats/samples.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "harness/stats/statistics.h"
#include "harness/stats/tables/tables.h"
#include "tests/harness/input_fault.h"
#include "tests/harness/packed.h"
#include "tests/harness/stats/sample_file.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone::stats {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class Samples : public testing::Test {
 protected:
  stats::Results read(const FakeRun& run) {
    return stats::read_results(run.write(folder_.path() / "r"));
  }
  TemporaryFolder folder_;
};

TEST_F(Samples, SetsContestantsAndSquares) {
  const stats::Results results = read(fake_run());
  EXPECT_EQ(results.campaign, "fake");
  EXPECT_THAT(results.isa, ElementsAre("avx2"));
  EXPECT_EQ(results.machine.at("processor"), "Test CPU");
  ASSERT_EQ(results.sets.size(), 2u);
  const stats::SampleSet& broad = results.sets[0];
  EXPECT_EQ(broad.key.words(), "uniform, 1000 bodies, tight boxes, 2 threads, broad phases");
  ASSERT_EQ(broad.contestants.size(), 3u);
  EXPECT_EQ(broad.baseline().label, "sweep-one-axis");
  EXPECT_EQ(broad.twin.samples.size(), 3u * 4 * 4);
  const stats::Contestant& first = broad.contestants[0];
  EXPECT_EQ(first.samples.size(), 3u * 4 * 4);
  EXPECT_EQ(first.checks.size(), 8u);
  EXPECT_TRUE(std::isnan(first.samples[0].parts[0]));
  EXPECT_NEAR(first.samples[0].parts[1] * 3, first.samples[0].parts[2], 1e-9);
  EXPECT_EQ(stats::by_square(first, stats::Noise::left_out).size(), 12u);
  const stats::SampleSet& narrow = results.sets[1];
  EXPECT_EQ(narrow.key.words(),
            "uniform, 1000 bodies, tight boxes, 2 threads, distance box-sphere");
  EXPECT_EQ(narrow.contestants[1].label, "mpr double");
  EXPECT_EQ(narrow.contestants[0].samples[0].units, 8 * 50);
}

TEST_F(Samples, TimesAreASumOfPhasesForAUnit) {
  const stats::Results results = read(fake_run());
  const auto middle = [&](std::size_t set, std::size_t contestant) {
    std::vector<double> values;
    for (const auto& [square, value] :
         stats::by_square(results.sets[set].contestants[contestant], stats::Noise::left_out)) {
      values.push_back(value);
    }
    return stats::median(values);
  };
  EXPECT_NEAR(middle(0, 1) / 2e-3, 1, 0.1);
  EXPECT_NEAR(middle(1, 0) / 100e-9, 1, 0.1);
}

TEST_F(Samples, RatiosArePairedBySquare) {
  // The factor that a square shares, which here varies by half, cancels.
  FakeRun run = fake_run();
  run.square_spread = 0.5;
  const stats::Results results = read(run);
  const stats::SampleSet& set = results.sets[0];
  const auto ratios =
      stats::paired_log_ratios(set.contestants[1], set.contestants[0], stats::Noise::left_out);
  ASSERT_EQ(ratios.size(), 12u);
  for (const double ratio : ratios) EXPECT_NEAR(std::exp(ratio), 2, 0.02);
}

TEST_F(Samples, NoisyRoundsAreLeftOutUnlessAskedFor) {
  FakeRun run = fake_run();
  run.noisy_squares = 1;
  const stats::Results results = read(run);
  const stats::Contestant& contestant = results.sets[0].contestants[0];
  EXPECT_EQ(stats::by_square(contestant, stats::Noise::left_out).size(), 9u);
  EXPECT_EQ(stats::by_square(contestant, stats::Noise::kept).size(), 12u);
  EXPECT_GT(stats::by_square(contestant, stats::Noise::kept).at({0, 0}), 5e-3);
}

TEST_F(Samples, APackedFileIsReadWhereThereIsNoPlainOne) {
  const std::filesystem::path results = fake_run().write(folder_.path() / "r");
  const auto tables = [&](const std::filesystem::path& file, const std::string& out) {
    std::filesystem::create_directory(folder_.path() / out);
    stats::write_tables(stats::make_tables(stats::read_results(file), stats::Noise::left_out), 1.5,
                        folder_.path() / out);
  };
  tables(results, "plain");
  pack(results / "raw.csv");
  tables(results, "packed");
  tables(results / "raw.csv.zst", "named");
  std::size_t written = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path() / "plain")) {
    const std::string name = entry.path().filename().string();
    const std::string plain = folder_.read("plain/" + name);
    EXPECT_EQ(folder_.read("packed/" + name), plain);
    EXPECT_EQ(folder_.read("named/" + name), plain);
    ++written;
  }
  EXPECT_GT(written, 5u);
  EXPECT_EQ(stats::read_results(results).file, results / "raw.csv.zst");
  EXPECT_FALSE(stats::read_results(results).machine.empty());
}

TEST_F(Samples, FailuresAreRemembered) {
  FakeRun run = fake_run();
  run.blocks[0].contestants[1].status = "crashed";
  const stats::Results results = read(run);
  EXPECT_EQ(results.sets[0].contestants[1].failure, record::RowStatus::crashed);
  EXPECT_TRUE(results.sets[0].contestants[1].samples.empty());
  EXPECT_EQ(results.sets[0].contestants[0].failure, std::nullopt);
}

TEST_F(Samples, MalformedFilesAreToldWithTheirLine) {
  const std::string raw = fake_run().raw();
  const auto fault = [&](const std::string& from, const std::string& to) {
    std::string text = raw;
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
    const auto file = folder_.write("raw.csv", text);
    return folder_.without_path(input_fault([&] { stats::read_results(file); }));
  };
  EXPECT_THAT(fault("ok,check", "ok,chequed"),
              HasSubstr("raw.csv:2: column kind: found 'chequed'; expected one of check, sample"));
  EXPECT_THAT(fault(",find_pairs,", ",find,"), HasSubstr("raw.csv:2: column phase: found 'find'"));
  // This row is not read.
  EXPECT_THAT(fault(",find_pairs,0.001,", ",find_pairs,-1,"), testing::IsEmpty());
  EXPECT_THAT(
      fault("sample,0,0,0,0,0,8", "sample,0,0,0,0,0,0"),
      HasSubstr("raw.csv:26: column frames: found '0'; expected a whole number of at least 1"));
  EXPECT_THAT(fault("sample,0,0,0,0,0,8", "sample,0,0,,0,0,8"),
              HasSubstr("raw.csv:26: column square: found ''"));
  EXPECT_THAT(fault(",update,", ",update,-"), HasSubstr("raw.csv:26: column seconds"));
  EXPECT_THAT(fault(",kind,", ",kin,"), HasSubstr("raw.csv:1: no column 'kind'"));
  EXPECT_THAT(fault("1000", "many"), HasSubstr("raw.csv:2: column bodies: found 'many'"));
  folder_.write("raw.csv", raw.substr(0, raw.size() - 30));
  EXPECT_THAT(folder_.without_path(input_fault([&] { stats::read_results(folder_.path()); })),
              HasSubstr("expected 44, as in the header"));
  EXPECT_THAT(input_fault([&] { stats::read_results(folder_.path() / "none"); }),
              HasSubstr("No such file"));
}

// Two windows: the first was played three times, once under noise.
TEST(WorstFrame, IsThatOfTheWindowWhoseLeastIsGreatest) {
  Contestant contestant;
  const auto play = [&](std::int64_t frame, std::int64_t round, double update, double worst,
                        bool noisy = false) {
    Sample sample;
    sample.round = round;
    sample.units = 4;
    sample.frame = frame;
    sample.noisy = noisy;
    add_phase(contestant, record::Phase::update, sample, update);
    sample.worst_frame = worst;  // it stands in the sample's last row
    add_phase(contestant, record::Phase::find_pairs, sample, 1);
  };
  EXPECT_TRUE(std::isnan(worst_frame(contestant, Noise::left_out)));
  play(1, 0, 3, 2);
  play(1, 1, 9, 8);
  play(1, 2, 1, 0.5, true);
  EXPECT_EQ(worst_frame(contestant, Noise::left_out), 2);
  EXPECT_EQ(worst_frame(contestant, Noise::kept), 0.5);
  play(5, 3, 3, 2.5);
  EXPECT_EQ(contestant.samples.size(), 4u);
  EXPECT_EQ(worst_frame(contestant, Noise::left_out), 2.5);
  EXPECT_EQ(worst_frame(contestant, Noise::kept), 2.5);
  play(9, 4, 3, nan);
  EXPECT_EQ(worst_frame(contestant, Noise::left_out), 2.5);
}

}  // namespace
}  // namespace touchstone::stats
