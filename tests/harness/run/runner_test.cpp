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

TEST_F(Runner, ChecksEveryFrameAndTakesTheSquaresAskedFor) {
  const Campaign c = campaign(
      "broad = ['naive', 'uniform-grid']\nnarrow = ['gjk', 'sat']\n"
      "scalars = 'double'\ntasks = ['intersect', 'penetration']\nsquares = 6");
  const RunResult result = run_campaign(c, out());
  EXPECT_FALSE(result.findings.ours_are_wrong()) << departures(result.findings);
  const std::vector<RawRow> rows = read_raw_rows(out() / "raw.csv");
  EXPECT_EQ(rows.size(), result.findings.rows().size());
  std::map<Phase, int> checks, samples;
  std::map<std::int64_t, std::set<std::string>> hashes;
  std::map<std::string, std::set<std::int64_t>> processes;
  int stops = 0;
  for (const RawRow& row : rows) {
    ++(row.kind == RowKind::check ? checks : samples)[row.phase];
    EXPECT_TRUE(row.status == "unsupported" || row.seconds > 0);
    EXPECT_EQ(row.kind == RowKind::sample, row.square >= 0);
    if (row.kind == RowKind::sample) processes[label_of(row)].insert(row.process);
    if (row.kind == RowKind::check && row.phase == Phase::find_pairs) {
      hashes[row.frame].insert(row.pair_hash);
    }
    if (!row.stop.empty()) {
      ++stops;
      EXPECT_EQ(row.stop, "rounds");
    }
  }
  EXPECT_EQ(checks[Phase::build], 2);
  EXPECT_EQ(checks[Phase::update], 4);
  EXPECT_EQ(checks[Phase::find_pairs], 6);
  // gjk and sat, two tasks, three frames, six kinds of pairs.
  EXPECT_EQ(checks[Phase::narrow], 2 * 2 * 3 * 6);
  ASSERT_EQ(hashes.size(), 3u);
  for (const auto& [frame, set] : hashes) EXPECT_EQ(set.size(), 1u);
  // Two contestants and the twin: squares of three rounds.
  EXPECT_EQ(samples[Phase::update], 6 * 3 * 3);
  EXPECT_EQ(samples[Phase::find_pairs], 6 * 3 * 3);
  EXPECT_EQ(processes["uniform-grid"], (std::set<std::int64_t>{0, 1, 2}));
  EXPECT_EQ(stops, 1 + 2 * 6);  // a set
  EXPECT_TRUE(std::filesystem::exists(out() / "machine.csv"));
}

TEST_F(Runner, GivesTheSameAnswersAtEveryWidthInEveryCombination) {
  const Campaign c = campaign(
      "broad = 'ours'\nnarrow = 'ours'\nthreads = [1, 2, 3]\npairing = 'product'\nframes = 2\n"
      "tasks = ['intersect', 'distance', 'penetration']\nboxes = ['tight', 'loose']\n"
      "seconds = 1e-6");
  const RunResult result = run_campaign(c, out());
  EXPECT_FALSE(result.findings.ours_are_wrong()) << departures(result.findings);
  std::map<std::string, std::set<std::string>> by_cell;
  std::set<std::string> combinations;
  for (const RawRow& row : result.findings.rows()) {
    EXPECT_NE(row.status, status_wrong) << label_of(row);
    if (row.kind == RowKind::sample && row.phase == Phase::narrow) {
      combinations.insert(row.broad + " " + row.narrow);
    }
    if (row.kind != RowKind::check || row.pair_hash.empty()) continue;
    by_cell[row.broad + row.narrow + row.scalar + row.task + row.boxes + row.pair_kind +
            std::to_string(row.frame)]
        .insert(row.pair_hash + row.outcome_hash);
  }
  for (const auto& [cell, hashes] : by_cell) EXPECT_EQ(hashes.size(), 1u) << cell;
  EXPECT_GE(combinations.size(), 20u);
}

TEST_F(Runner, TablesNameEveryAlgorithm) {
  const Campaign c = campaign("broad = 'ours'\nnarrow = 'ours'\nseconds = 0.5");
  const RunResult result = run_campaign(c, out());
  const ReportStyle style = {.page_width = 120, .noisy = true};
  const std::string broad = broad_table(result.findings, style);
  const std::string narrow = narrow_tables(result.findings, style);
  for (const BroadPhaseEntry* entry : c.groups[0].broad) {
    EXPECT_THAT(broad, testing::HasSubstr(entry->info.name));
  }
  for (const NarrowChoice& choice : c.groups[0].narrow) {
    if (offers(*choice.entry, Task::intersect)) {
      EXPECT_THAT(narrow, testing::HasSubstr(choice.entry->info.name));
    }
  }
  EXPECT_THAT(broad, testing::ContainsRegex("[*=][0-9]"));
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

TEST_F(Runner, RulesLeaveCellsOut) {
  const Campaign c = campaign(
      "broad = ['naive', 'uniform-grid']\nnarrow = ['gjk', 'sat']\ncounts = [30, 60]\n"
      "exclude = [{broad = 'naive', counts_above = 40}, {narrow = 'gjk', scalar = 'float'},\n"
      "           {narrow = 'sat', pair_kind = 'box-box'}]\nseconds = 0.05");
  const RunResult result = run_campaign(c, out());
  std::set<std::string> cells;
  for (const RawRow& row : result.findings.rows()) {
    if (row.status == "unsupported") continue;
    cells.insert(label_of(row) + " " + std::to_string(row.bodies) + " " + row.pair_kind);
  }
  EXPECT_TRUE(cells.contains("naive 30 "));
  EXPECT_FALSE(cells.contains("naive 60 "));
  EXPECT_TRUE(cells.contains("uniform-grid 60 "));
  EXPECT_TRUE(cells.contains("gjk double 60 box-box"));
  EXPECT_FALSE(cells.contains("gjk float 60 box-box"));
  EXPECT_FALSE(cells.contains("sat double 60 box-box"));
  EXPECT_TRUE(cells.contains("sat double 60 box-hull"));
  const std::vector<PlannedBlock> plan = plan_campaign(c);
  ASSERT_EQ(plan.size(), 2u);
  EXPECT_THAT(plan[1].sets[0].contestants, testing::ElementsAre("uniform-grid"));
}

}  // namespace
