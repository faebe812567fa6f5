#include "harness/run/runner.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <set>

#include "harness/error.h"
#include "harness/io/csv.h"
#include "harness/run/raw_row.h"
#include "harness/run/report.h"
#include "tests/harness/temporary_folder.h"

namespace {

using namespace touchstone;

class Runner : public testing::Test {
 protected:
  Campaign campaign(const std::string& text) {
    std::ofstream(folder_.path() / "scene.toml")
        << "generator = 'uniform'\ncount = 150\noverlaps = 4\n"
           "frames = 3\nshapes = ['box', 'sphere', 'hull']\n";
    std::ofstream(folder_.path() / "c.toml") << "scenes = 'scene.toml'\n" << text;
    return read_campaign(folder_.path() / "c.toml");
  }
  std::filesystem::path out() const { return folder_.path() / "out"; }
  TemporaryFolder folder_;
};

TEST_F(Runner, WritesARowForEveryMeasurement) {
  const Campaign c = campaign(
      "broad = ['naive', 'uniform-grid']\nnarrow = ['gjk', 'sat']\n"
      "scalars = 'double'\ntasks = ['intersect', 'penetration']");
  const RunResult result = run_campaign(c, out());
  EXPECT_FALSE(result.findings.ours_are_wrong()) << departures(result.findings);
  const CsvReader raw(out() / "raw.csv", {"frame", "broad", "narrow", "phase", "seconds", "status",
                                          "pair_hash", "pair_kind", "task"});
  std::size_t rows = 0;
  std::map<std::string, int> phases;
  std::map<std::string, std::set<std::string>> hashes;
  raw.read([&](const CsvReader::Row& row) {
    ++rows;
    ++phases[std::string(row.text(3))];
    if (row.text(3) == "find_pairs")
      hashes[std::string(row.text(0))].insert(std::string(row.text(6)));
    EXPECT_TRUE(row.text(5) == "unsupported" || row.number(4) > 0);
  });
  EXPECT_EQ(rows, result.findings.rows().size());
  EXPECT_EQ(phases["build"], 2);
  EXPECT_EQ(phases["update"], 4);
  EXPECT_EQ(phases["find_pairs"], 6);
  // gjk and sat, two tasks, three frames, six kinds of pairs.
  EXPECT_EQ(phases["narrow"], 2 * 2 * 3 * 6);
  ASSERT_EQ(hashes.size(), 3u);
  for (const auto& [frame, set] : hashes) EXPECT_EQ(set.size(), 1u);
  EXPECT_TRUE(std::filesystem::exists(out() / "machine.csv"));
}

TEST_F(Runner, GivesTheSameHashesAtEveryWidthInEveryCombination) {
  const Campaign c = campaign(
      "broad = 'ours'\nnarrow = 'ours'\nthreads = [1, 2, 3]\npairing = 'product'\n"
      "tasks = ['intersect', 'distance', 'penetration']\nboxes = ['tight', 'loose']");
  const RunResult result = run_campaign(c, out());
  EXPECT_FALSE(result.findings.ours_are_wrong()) << departures(result.findings);
  std::map<std::string, std::set<std::string>> by_cell;
  std::set<std::string> combinations;
  for (const RawRow& row : result.findings.rows()) {
    if (row.pair_hash.empty()) continue;
    by_cell[row.broad + row.narrow + row.scalar + row.task + row.boxes + row.pair_kind +
            std::to_string(row.frame)]
        .insert(row.pair_hash + row.outcome_hash);
    if (row.phase == Phase::narrow) combinations.insert(row.broad + " " + row.narrow);
  }
  for (const auto& [cell, hashes] : by_cell) EXPECT_EQ(hashes.size(), 1u) << cell;
  EXPECT_GE(combinations.size(), 20u);
}

TEST_F(Runner, TablesNameEveryAlgorithmAndMarkTheFastest) {
  const Campaign c = campaign("broad = 'ours'\nnarrow = 'ours'");
  const RunResult result = run_campaign(c, out());
  const std::string broad = broad_table(result.findings, 120);
  const std::string narrow = narrow_tables(result.findings, 120);
  for (const BroadPhaseEntry* entry : c.groups[0].broad) {
    EXPECT_THAT(broad, testing::HasSubstr(entry->info.name));
  }
  for (const NarrowChoice& choice : c.groups[0].narrow) {
    if (offers(*choice.entry, Task::intersect)) {
      EXPECT_THAT(narrow, testing::HasSubstr(choice.entry->info.name));
    }
  }
  EXPECT_THAT(broad, testing::HasSubstr("*"));
  EXPECT_THAT(broad, testing::HasSubstr("all 3 frames"));
  EXPECT_THAT(narrow, testing::HasSubstr("agreement with exact"));
}

TEST_F(Runner, LeavesNothingBehindWhenASceneIsWrong) {
  Campaign c = campaign("");
  std::ofstream(folder_.path() / "scene.toml") << "generator = 'uniform'\ncount = -3\n";
  EXPECT_THROW(run_campaign(c, out()), InputError);
  EXPECT_FALSE(std::filesystem::exists(out()));
}

TEST_F(Runner, LeavesOutWhatIsTooSlowAndSaysSo) {
  const Campaign c = campaign("broad = 'naive'\nnarrow = 'none'\ntime_limit = 1e-9");
  const RunResult result = run_campaign(c, out());
  int lost = 0;
  for (const RawRow& row : result.findings.rows()) lost += row.status == "timed_out";
  EXPECT_EQ(lost, 1);
  EXPECT_FALSE(result.findings.ours_are_wrong());
  EXPECT_THAT(departures(result.findings), testing::HasSubstr("over the limit"));
}

}  // namespace
