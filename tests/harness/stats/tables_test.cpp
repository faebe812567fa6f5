// Tests of the tables of a results folder.
#include "harness/stats/tables/tables.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "harness/stats/table_check.h"
#include "tests/harness/input_fault.h"
#include "tests/harness/stats/sample_file.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone::stats {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class TablesOf : public testing::Test {
 protected:
  std::filesystem::path write(const FakeRun& run, const std::string& name = "r") {
    return run.write(folder_.path() / name);
  }
  stats::Tables make(const FakeRun& run, stats::Noise noise = stats::Noise::left_out) {
    return stats::make_tables(stats::read_results(write(run)), noise);
  }
  TemporaryFolder folder_;
};

TEST_F(TablesOf, TimesRatiosAndWinners) {
  const stats::Tables tables = make(fake_run());
  ASSERT_EQ(tables.times.size(), 5u);
  EXPECT_NEAR(tables.times[1].seconds.median / 2e-3, 1, 0.1);
  EXPECT_LT(tables.times[1].seconds.low, tables.times[1].seconds.median);
  EXPECT_LT(tables.times[1].minimum, tables.times[1].seconds.low);
  EXPECT_EQ(tables.times[1].origin, record::RowOrigin::ours);
  EXPECT_NEAR(tables.times[1].parts[2] / tables.times[1].parts[1], 3, 0.1);
  EXPECT_NEAR(tables.times[3].seconds.median / 100e-9, 1, 0.1);

  ASSERT_EQ(tables.ratios.size(), 5u);  // 2 + canary, 1 + canary
  EXPECT_NEAR(tables.ratios[0].ratio.median, 2, 0.01);
  EXPECT_LT(tables.ratios[0].ratio.high, 2.02);
  EXPECT_GT(tables.ratios[0].ratio.low, 1.98);
  EXPECT_TRUE(tables.ratios[2].canary);
  EXPECT_NEAR(tables.ratios[2].ratio.median, 1, 0.01);

  ASSERT_EQ(tables.winners.size(), 2u);
  EXPECT_EQ(tables.winners[0].winner, "sweep-one-axis");
  EXPECT_EQ(tables.winners[0].runner_up, "uniform-grid");
  EXPECT_NEAR(tables.winners[0].ratio.median, 2, 0.01);
  EXPECT_EQ(tables.winners[1].winner, "gjk double");
  EXPECT_NEAR(tables.winners[1].ratio.median, 1.3, 0.01);
}

TEST_F(TablesOf, WhoIsWrongOrFailedDoesNotWin) {
  FakeRun run = fake_run();
  run.blocks[0].contestants[0].pair_hash = "00000000000000bb";
  run.blocks[1].contestants.push_back({"sat", 50e-9, "00000000000000aa", "ok", 3});
  const stats::Tables tables = make(run);
  EXPECT_TRUE(tables.times[0].wrong);
  EXPECT_FALSE(tables.times[1].wrong);
  EXPECT_TRUE(tables.times[5].wrong);
  EXPECT_EQ(tables.winners[0].winner, "uniform-grid");
  EXPECT_EQ(tables.winners[1].winner, "gjk double");
  ASSERT_EQ(tables.agreement.size(), 3u);
  EXPECT_EQ(tables.agreement[2].queries, 8 * 50);
  EXPECT_EQ(tables.agreement[2].wrong, 8 * 3);
  EXPECT_EQ(tables.agreement[2].right, 8 * 47);
  EXPECT_EQ(tables.agreement[2].unanswered, 0);
}

TEST_F(TablesOf, TheBestOfOursAgainstTheBestOfOthers) {
  FakeRun run;
  for (const int threads : {1, 2}) {
    for (const int bodies : {1000, 10'000, 100'000}) {
      FakeBlock block;
      block.bodies = bodies;
      block.threads = threads;
      block.scene_hash = std::to_string(bodies);
      const double ours = (bodies == 1000 ? 5e-6 : 1e-6 * bodies) / (threads == 2 ? 1.6 : 1);
      block.contestants = {{"sweep-one-axis", 2 * ours},
                           {"uniform-grid", ours},
                           {"naive", 0.5 * ours, "00000000000000bb"},  // a wrong hash
                           {"limit", 0.25 * ours}};
      if (threads == 1) {
        block.contestants.push_back({"some-peer", 3 * ours});
        block.contestants.push_back({"bullet-tree", 8 * ours});
        block.contestants.push_back({"fcl-sap", 6 * ours});
      }
      block.contestants[1].work = ",,40,,,2400000,,";
      run.blocks.push_back(block);
    }
  }
  // 'naive' is the reference if it is present: here most are right.
  for (FakeBlock& block : run.blocks) block.contestants[2].name = "loose-octree";
  const stats::Tables tables = make(run);
  for (const stats::WinnerRow& row : tables.winners) EXPECT_EQ(row.winner, "uniform-grid");
  ASSERT_EQ(tables.broad_best.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) {
    const stats::BroadBestRow& row = tables.broad_best[i];
    EXPECT_EQ(row.ours.label, "uniform-grid");
    EXPECT_NEAR(row.ours.ratio.median, 1, 1e-12);
    EXPECT_NEAR(row.over_limit.median, 4, 0.05);
    EXPECT_NEAR(row.bytes_a_body * static_cast<double>(row.key.bodies), 2'400'000, 1);
    EXPECT_NEAR(row.exponent, 1, 0.05) << "without the thousand";
    EXPECT_EQ(row.base_threads, i < 3 ? 0 : 1);
    if (i >= 3) {
      EXPECT_NEAR(row.speed_up.median, 1.6, 0.1);
      EXPECT_TRUE(row.peer.label.empty());
      continue;
    }
    EXPECT_TRUE(std::isnan(row.speed_up.median));
    EXPECT_EQ(row.peer.label, "some-peer");
    EXPECT_NEAR(row.peer.ratio.median, 3, 0.05);
    EXPECT_LT(row.peer.ratio.low, row.peer.ratio.high);
    EXPECT_EQ(row.bullet_or_fcl.label, "fcl-sap");
    EXPECT_NEAR(row.bullet_or_fcl.ratio.median, 6, 0.1);
  }
  std::filesystem::create_directory(folder_.path() / "out");
  stats::write_tables(tables, 1.5, folder_.path() / "out");
  EXPECT_THAT(folder_.read("out/broad_best.csv"), HasSubstr(",uniform-grid,"));
  EXPECT_THAT(folder_.read("out/tables.md"), HasSubstr("| some-peer | fcl-sap |"));
}

TEST_F(TablesOf, SpeedAndErrorOfTheBestNarrowPhases) {
  FakeRun run;
  FakeBlock block;
  block.task = "penetration";
  block.pair_kind = "hull-hull";
  block.contestants = {{"gjk", 100e-9, "00000000000000aa", "ok", 0, ",,,,,,,", "1e-14"},
                       {"sat", 80e-9, "00000000000000aa", "ok", 0, ",,,,,,,", "0.2"},
                       {"fcl-libccd", 50e-9, "00000000000000aa", "ok", 2, ",,,,,,,", "1e-14"},
                       {"bullet-mpr", 200e-9, "00000000000000aa", "ok", 0, ",,,,,,,", "0.5"},
                       {"bullet-gjk-epa", 300e-9, "00000000000000aa", "ok", 0, ",,,,,,,", "1e-4"}};
  run.blocks = {block};
  const stats::Tables tables = make(run);
  ASSERT_EQ(tables.narrow_best.size(), 1u);
  const stats::NarrowBestRow& row = tables.narrow_best[0];
  EXPECT_EQ(row.ours.label, "gjk double") << "sat is off by too much";
  EXPECT_EQ(row.ours.worst_error, 1e-14);
  EXPECT_EQ(row.right_peer.label, "bullet-gjk-epa double");
  EXPECT_NEAR(row.right_peer.ratio.median, 3, 0.05);
  EXPECT_EQ(row.any_peer.label, "fcl-libccd double");
  EXPECT_EQ(row.any_peer.wrong, 16);
  EXPECT_EQ(row.any_peer.queries, 400);
  std::filesystem::create_directory(folder_.path() / "out");
  stats::write_tables(tables, 1.5, folder_.path() / "out");
  EXPECT_THAT(folder_.read("out/narrow_best.csv"), HasSubstr(",bullet-gjk-epa double,"));
  EXPECT_THAT(folder_.read("out/tables.md"), HasSubstr("| 16 of 400 | 1e-14 |"));
}

// What is asked in batches does not compete with what is asked pair by pair.
TEST_F(TablesOf, BatchesAreComparedWithTheirOwn) {
  FakeRun run;
  FakeBlock block;
  block.task = "intersect";
  block.pair_kind = "hull-hull";
  block.contestants = {{"gjk", 100e-9, "00000000000000aa", "ok", 0, ",,,,,,,", "", "1"},
                       {"gjk-lanes", 40e-9},
                       {"sat", 50e-9},
                       {"bullet-gjk-epa", 200e-9, "00000000000000aa", "ok", 0, ",,,,,,,", "", "1"}};
  run.blocks = {block};
  const stats::Tables tables = make(run);
  ASSERT_EQ(tables.winners.size(), 2u);
  EXPECT_EQ(tables.winners[0].batch, -1);
  EXPECT_EQ(tables.winners[0].winner, "gjk-lanes double");
  EXPECT_EQ(tables.winners[0].runner_up, "sat double");
  EXPECT_EQ(tables.winners[1].batch, 1);
  EXPECT_EQ(tables.winners[1].winner, "gjk double by 1");
  EXPECT_NEAR(tables.winners[1].ratio.median, 2, 0.05);
  ASSERT_EQ(tables.narrow_best.size(), 2u);
  EXPECT_EQ(tables.narrow_best[0].ours.label, "gjk-lanes double");
  EXPECT_EQ(tables.narrow_best[0].any_peer.label, "");
  EXPECT_EQ(tables.narrow_best[1].ours.label, "gjk double by 1");
  EXPECT_EQ(tables.narrow_best[1].right_peer.label, "bullet-gjk-epa double by 1");
}

TEST_F(TablesOf, NoiseIsLeftOutUnlessAskedForAndOutliersStay) {
  FakeRun run = fake_run();
  run.noisy_squares = 1;
  EXPECT_EQ(make(run).times[0].seconds.n, 9u);
  EXPECT_EQ(make(run).times[0].noisy, 12);
  EXPECT_LT(make(run).times[0].outliers, 3);
  const stats::Tables noisy = make(run, stats::Noise::kept);
  EXPECT_EQ(noisy.times[0].seconds.n, 12u);
  EXPECT_EQ(noisy.times[0].outliers, 12);
}

TEST_F(TablesOf, ExponentsAndSpeedUps) {
  FakeRun run;
  for (const int threads : {1, 2}) {
    for (const int bodies : {1000, 4000, 16000}) {
      FakeBlock block;
      block.bodies = bodies;
      block.threads = threads;
      block.scene_hash = std::to_string(bodies);
      block.contestants = {{"sweep-one-axis", 1e-6 * bodies / (threads == 2 ? 1.8 : 1)},
                           {"naive", 1e-9 * bodies * bodies}};
      run.blocks.push_back(block);
    }
  }
  run.square_spread = 0.002;
  const stats::Tables tables = make(run);
  ASSERT_EQ(tables.exponents.size(), 4u);
  EXPECT_NEAR(tables.exponents[0].law.exponent, 1, 0.01);
  EXPECT_NEAR(tables.exponents[1].law.exponent, 2, 0.01);
  EXPECT_LE(tables.exponents[1].law.low, 2.01);
  EXPECT_THAT(tables.exponents[1].counts, ElementsAre(1000, 4000, 16000));
  ASSERT_EQ(tables.speed_ups.size(), 12u);
  for (const stats::SpeedUpRow& row : tables.speed_ups) {
    const double expected = row.key.threads == 2 && row.label == "sweep-one-axis" ? 1.8 : 1;
    EXPECT_NEAR(row.speed_up.median, expected, 0.02) << row.label;
    EXPECT_EQ(row.base_threads, 1);
  }
}

TEST_F(TablesOf, FilesAreTheSameBytesTwiceAndSayWhatTheyAreOf) {
  const stats::Tables tables = make(fake_run());
  for (const char* name : {"one", "two"}) {
    std::filesystem::create_directory(folder_.path() / name);
    stats::write_tables(tables, 1.5, folder_.path() / name);
  }
  for (const char* name : {"tables.md", "times.csv", "ratios.csv", "winners.csv", "exponents.csv",
                           "speed_ups.csv", "executors.csv", "agreement.csv", "work.csv"}) {
    const std::string one = folder_.read(std::string("one/") + name);
    EXPECT_FALSE(one.empty()) << name;
    EXPECT_EQ(one, folder_.read(std::string("two/") + name)) << name;
  }
  const std::string text = folder_.read("one/tables.md");
  EXPECT_THAT(text, HasSubstr("- processor: Test CPU"));
  EXPECT_THAT(text, HasSubstr("### uniform, 1000 bodies, tight boxes, 2 threads, broad phases"));
  EXPECT_THAT(text, HasSubstr("Ratios are to sweep-one-axis. The canary, sweep-one-axis against "
                              "itself: "));
}

TEST_F(TablesOf, WorkABodyAPairAndAQuery) {
  FakeRun run = fake_run();  // it has 8 frames of 50 pairs, 1000 bodies
  run.blocks[0].contestants[1].work = ",,4000,500,75,32000,3,120";
  run.blocks[1].contestants[0].work = "200,250,,,,,0,0";
  const stats::Tables tables = make(run);
  ASSERT_EQ(tables.work.size(), 2u);  // a contestant without counts has no row
  const stats::WorkRow& grid = tables.work[0];
  EXPECT_EQ(grid.label, "uniform-grid");
  EXPECT_EQ(grid.frames, 8);
  EXPECT_EQ(grid.queries, 400);
  EXPECT_DOUBLE_EQ(grid.box_tests, 4);
  EXPECT_DOUBLE_EQ(grid.node_visits, 0.5);
  EXPECT_DOUBLE_EQ(grid.candidates, 1.5);
  EXPECT_DOUBLE_EQ(grid.bytes, 32);
  EXPECT_DOUBLE_EQ(grid.allocations, 3);
  EXPECT_DOUBLE_EQ(grid.allocated_bytes, 120);
  EXPECT_TRUE(std::isnan(grid.iterations));
  const stats::WorkRow& gjk = tables.work[1];
  EXPECT_EQ(gjk.label, "gjk double");
  EXPECT_DOUBLE_EQ(gjk.iterations, 4);
  EXPECT_DOUBLE_EQ(gjk.support_calls, 5);
  EXPECT_DOUBLE_EQ(gjk.allocations, 0);
  EXPECT_TRUE(std::isnan(gjk.box_tests));
  std::filesystem::create_directory(folder_.path() / "w");
  stats::write_tables(tables, 1.5, folder_.path() / "w");
  const std::string text = folder_.read("w/tables.md");
  EXPECT_THAT(text, HasSubstr("## Work"));
  EXPECT_THAT(text, HasSubstr("| uniform-grid | 4 | 0.5 | 1.5 | 32 | 3 | 120 |"));
  EXPECT_THAT(text, HasSubstr("| distance | gjk double | 4 | 5 | 0 | 0 |"));
  EXPECT_THAT(folder_.read("w/work.csv"),
              HasSubstr("uniform-grid,ours,8,400,4,0.5,1.5,32,,,frame,3"));
}

TEST_F(TablesOf, ACanaryThatIsToldApartIsTold) {
  FakeRun run = fake_run();
  const auto text = [&] {
    std::filesystem::create_directory(folder_.path() / "t");
    stats::write_tables(make(run), 1.5, folder_.path() / "t");
    return folder_.read("t/tables.md");
  };
  EXPECT_THAT(text(), testing::Not(HasSubstr("told apart")));
  run.blocks[0].twin_factor = 1.05;
  EXPECT_THAT(text(), HasSubstr("told apart"));
}

TEST_F(TablesOf, ASuspectSetIsMarkedAndProvesNothing) {
  FakeRun run = fake_run();
  const auto reference = write(run, "reference");
  stats::write_tables(make(run), 1.2, reference);
  run.blocks[0].suspect = true;
  const stats::Tables tables = make(run);
  for (const stats::RatioRow& row : tables.ratios)
    EXPECT_EQ(row.suspect, !row.key.narrow()) << row.label;
  for (const stats::WinnerRow& row : tables.winners) EXPECT_EQ(row.suspect, !row.key.narrow());
  EXPECT_EQ(tables.times[0].noisy, 0) << "the round of the word is as good as the others";
  const auto folder = write(run, "suspect");
  stats::write_tables(tables, 1.2, folder);
  const std::string text = folder_.read("suspect/tables.md");
  EXPECT_THAT(text, HasSubstr("broad phases (**suspect**) | sweep-one-axis"));
  EXPECT_THAT(text, HasSubstr("this table is **suspect**"));
  const auto undecided = [](const stats::TableCheck& check) {
    return std::ranges::count(check.cells, stats::Holds::undecided, &stats::CheckedCell::state);
  };
  EXPECT_EQ(undecided(stats::check_tables(reference, stats::read_results(reference),
                                          stats::Noise::left_out)),
            0);
  EXPECT_EQ(undecided(stats::check_tables(reference, stats::read_results(folder),
                                          stats::Noise::left_out)),
            2);
  EXPECT_EQ(undecided(stats::check_tables(folder, stats::read_results(reference),
                                          stats::Noise::left_out)),
            2);
}

TEST_F(TablesOf, WorkOfAReferenceIsCheckedToTheDigit) {
  const auto changed = [&](const std::string& label, const std::string& stated,
                           const std::string& here) {
    FakeRun run = fake_run();
    run.blocks[0].contestants[1].name = label;
    run.blocks[0].contestants[1].work = stated;
    const auto reference = write(run, "reference");
    stats::write_tables(stats::make_tables(stats::read_results(reference), stats::Noise::left_out),
                        1.2, reference);
    run.blocks[0].contestants[1].work = here;
    return stats::check_tables(reference, stats::read_results(write(run, "here")),
                               stats::Noise::left_out)
        .changed;
  };
  const std::string work = ",,4000,500,75,32000,3,120";
  EXPECT_THAT(changed("uniform-grid", work, work), IsEmpty());
  EXPECT_THAT(changed("uniform-grid", work, ",,4001,500,75,32000,3,120"),
              ElementsAre(AllOf(HasSubstr("uniform-grid in uniform"),
                                HasSubstr("box tests 4000 in the reference, 4001 in these"))));
  EXPECT_THAT(changed("uniform-grid", work, ",,4000,500,75,32000,4,120"),
              ElementsAre(HasSubstr("allocations 3 in the reference, 4 in these")));
  // A library's allocations depend on its version, and some builds do not count them.
  EXPECT_THAT(changed("bullet-tree", work, ",,4000,500,75,32000,4,120"), IsEmpty());
  EXPECT_THAT(changed("bullet-tree", work, ",,4000,500,76,32000,3,120"),
              ElementsAre(HasSubstr("candidates 75 in the reference, 76 in these")));
  EXPECT_THAT(changed("uniform-grid", work, ",,4000,500,75,32000,,"), IsEmpty());
}

TEST(HoldsIn, IntervalAgainstTheBand) {
  const auto state = [](double low, double high) {
    return holds({(low + high) / 2, low, high, 12}, 1.5, 3);
  };
  EXPECT_EQ(state(1.6, 2.9), stats::Holds::pass);
  EXPECT_EQ(state(1.5, 3.0), stats::Holds::pass);
  EXPECT_EQ(state(1.0, 1.4), stats::Holds::differs);
  EXPECT_EQ(state(3.1, 9.9), stats::Holds::differs);
  EXPECT_EQ(state(0.70, 0.76), stats::Holds::differs);
  EXPECT_EQ(state(0.70, 0.74), stats::Holds::fail);
  EXPECT_EQ(state(5.9, 9.9), stats::Holds::differs);
  EXPECT_EQ(state(6.1, 9.9), stats::Holds::fail);
  EXPECT_EQ(state(1.4, 1.6), stats::Holds::undecided);
  EXPECT_EQ(state(1.0, 4.0), stats::Holds::undecided);
  EXPECT_EQ(state(0.0 / 0.0, 0.0 / 0.0), stats::Holds::undecided);
  EXPECT_EQ(holds({1, 1, 1, 12}, 0.0 / 0.0, 0.0 / 0.0), stats::Holds::undecided);
}

TEST_F(TablesOf, AReferenceIsCheckedCellByCell) {
  const auto reference = write(fake_run(), "reference");
  stats::write_tables(stats::make_tables(stats::read_results(reference), stats::Noise::left_out),
                      1.2, reference);
  const auto check = [&](const FakeRun& run) {
    return stats::check_tables(reference, stats::read_results(write(run, "here")),
                               stats::Noise::left_out);
  };
  const auto states = [](const stats::TableCheck& found) {
    std::vector<std::string> all;
    for (const stats::CheckedCell& cell : found.cells) {
      all.push_back(cell.label + " " + std::string(to_string(cell.state)));
    }
    return all;
  };
  // This machine is slower, with the same ratios.
  FakeRun run = fake_run();
  run.seed = 7;
  run.machine["processor"] = "Slow CPU";
  for (FakeBlock& block : run.blocks) {
    for (FakeContestant& c : block.contestants) c.seconds *= 7;
  }
  stats::TableCheck found = check(run);
  EXPECT_THAT(found.changed, IsEmpty());
  EXPECT_THAT(found.left_out, IsEmpty());
  EXPECT_THAT(states(found), ElementsAre("uniform-grid pass", "naive pass", "mpr double pass"));

  run.blocks[0].contestants[1].seconds *= 0.5;
  run.blocks[1].contestants.pop_back();
  found = check(run);
  EXPECT_THAT(states(found), ElementsAre("uniform-grid differs on this machine", "naive pass",
                                         "mpr double undecided"));
  EXPECT_THAT(found.left_out, ElementsAre(AllOf(HasSubstr("mpr double in uniform"),
                                                HasSubstr("is not in these results"))));

  run = fake_run();
  run.squares = 1;  // three squares give no interval
  EXPECT_THAT(states(check(run)),
              ElementsAre("uniform-grid undecided", "naive undecided", "mpr double undecided"));

  run = fake_run();
  run.blocks[0].contestants[2].pair_hash = "00000000000000bb";
  EXPECT_THAT(check(run).changed, ElementsAre(HasSubstr("pair hash 00000000000000aa in the "
                                                        "reference, 00000000000000bb in these "
                                                        "results")));
  // A counter that is missing in either is not compared.
  run = fake_run();
  run.blocks[0].contestants[1].work = ",,5,,,,,";
  EXPECT_THAT(check(run).changed, IsEmpty());
  run = fake_run();
  run.blocks[0].scene_hash = "1";
  EXPECT_THAT(check(run).changed, ElementsAre(HasSubstr("scene uniform with 1000 bodies")));

  folder_.write("reference/library_ratios.csv", "scene\nuniform\n");
  EXPECT_THAT(input_fault([&] { check(fake_run()); }), HasSubstr("ratios.csv:1: no column"));
}

TEST_F(TablesOf, ALibraryIsTheBaselineOfAReference) {
  FakeRun run = fake_run();
  run.blocks.resize(1);
  run.blocks[0].contestants = {
      {"sweep-one-axis", 1e-3}, {"uniform-grid", 2e-3}, {"bullet-tree", 4e-3}};
  const auto reference = write(run, "reference");
  const stats::Tables tables =
      stats::make_tables(stats::read_results(reference), stats::Noise::left_out);
  for (const stats::RatioRow& row : tables.library_ratios) EXPECT_EQ(row.baseline, "bullet-tree");
  stats::write_tables(tables, 1.2, reference);
  // The measured baseline is twice as fast: its ratio is better, and no other changes.
  run.blocks[0].contestants[0].seconds *= 0.5;
  const stats::TableCheck found = stats::check_tables(
      reference, stats::read_results(write(run, "here")), stats::Noise::left_out);
  ASSERT_EQ(found.cells.size(), 2u);
  EXPECT_EQ(found.cells[0].state, stats::Holds::faster);
  EXPECT_EQ(found.cells[1].state, stats::Holds::pass);
}

TEST_F(TablesOf, ADepthBeyondTheStatedErrorWinsNothing) {
  FakeRun run = fake_run();
  run.blocks.erase(run.blocks.begin());
  run.blocks[0].task = "penetration";
  run.blocks[0].contestants = {
      {"gjk", 100e-9, "00000000000000aa", "ok", 0, ",,,,,,,", "1e-6"},
      {"mpr", 130e-9, "00000000000000aa", "ok", 0, ",,,,,,,", "1e-5"},
      {"bullet-mpr", 50e-9, "00000000000000aa", "ok", 0, ",,,,,,,", "0.6"}};
  const stats::Results results = stats::read_results(write(run, "r"));
  const stats::Tables strict = stats::make_tables(results, stats::Noise::left_out);
  EXPECT_EQ(strict.winners.at(0).winner, "gjk double");
  EXPECT_THAT(stats::tables_markdown(strict), HasSubstr("**off by 0.6**"));
  const stats::Tables loose = stats::make_tables(results, stats::Noise::left_out, 0.7);
  EXPECT_EQ(loose.winners.at(0).winner, "bullet-mpr double");
}

}  // namespace
}  // namespace touchstone::stats
