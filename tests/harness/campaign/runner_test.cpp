// Tests of the rows of whole runs.
#include "harness/campaign/runner.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <map>
#include <set>

#include "harness/base/error.h"
#include "harness/campaign/plan.h"
#include "harness/files/csv.h"
#include "harness/record/raw_row.h"
#include "harness/stats/summary.h"
#include "harness/stats/tables/tables.h"
#include "tests/harness/temporary_folder.h"

namespace {

using namespace touchstone;

class Runner : public testing::Test {
 protected:
  campaign::Campaign campaign(const std::string& text) {
    std::ofstream(folder_.path() / "scene.toml")
        << "generator = 'uniform'\ncount = 150\noverlaps = 4\n"
           "frames = 3\nshapes = ['box', 'sphere', 'hull']\n";
    std::ofstream(folder_.path() / "c.toml") << "scenes = 'scene.toml'\n" << text;
    return campaign::read_campaign(folder_.path() / "c.toml");
  }
  std::filesystem::path out() const { return folder_.path() / "out"; }
  TemporaryFolder folder_;
};

TEST_F(Runner, ChecksEveryFrameAndTakesTheSquaresAskedFor) {
  const campaign::Campaign c = campaign(
      "broad = ['naive', 'uniform-grid']\nnarrow = ['gjk', 'sat']\n"
      "scalars = 'double'\ntasks = ['intersect', 'penetration']\nsquares = 6");
  const campaign::RunResult result = campaign::run_campaign(c, out());
  EXPECT_FALSE(result.findings.ours_are_wrong()) << record::departures_text(result.findings);
  const std::vector<record::RawRow> rows = record::read_rows<record::RawRow>(out() / "raw.csv");
  EXPECT_EQ(rows.size(), result.findings.rows().size());
  std::map<record::Phase, int> checks, samples;
  std::map<std::int64_t, std::set<std::string>> hashes;
  std::map<std::string, std::set<std::int64_t>> processes;
  int stops = 0;
  for (const record::RawRow& row : rows) {
    ++(row.kind == record::RowKind::check ? checks : samples)[row.phase];
    EXPECT_TRUE(row.status == record::RowStatus::unsupported || row.seconds > 0);
    EXPECT_EQ(row.kind == record::RowKind::sample, row.square >= 0);
    if (row.kind == record::RowKind::sample) processes[record::label_of(row)].insert(row.process);
    // A window has at least one frame, and its longest one is the build or update too.
    const bool has_worst =
        row.kind == record::RowKind::sample && row.phase == record::Phase::find_pairs;
    EXPECT_EQ(row.worst_frame > 0, has_worst);
    if (has_worst) {
      EXPECT_GT(row.worst_frame * static_cast<double>(row.frames), row.seconds);
    }
    if (row.kind == record::RowKind::check && row.phase == record::Phase::find_pairs) {
      hashes[row.frame].insert(row.pair_hash);
    }
    if (!row.stop.empty()) {
      ++stops;
      EXPECT_EQ(row.stop, "rounds");
    }
  }
  EXPECT_EQ(checks[record::Phase::build], 2);
  EXPECT_EQ(checks[record::Phase::update], 4);
  EXPECT_EQ(checks[record::Phase::find_pairs], 6);
  // The factors are gjk and sat, two tasks, three frames, six kinds of pairs.
  EXPECT_EQ(checks[record::Phase::narrow], 2 * 2 * 3 * 6);
  ASSERT_EQ(hashes.size(), 3u);
  for (const auto& [frame, set] : hashes) EXPECT_EQ(set.size(), 1u);
  // Two contestants and the twin make squares of three rounds.
  EXPECT_EQ(samples[record::Phase::update], 6 * 3 * 3);
  EXPECT_EQ(samples[record::Phase::find_pairs], 6 * 3 * 3);
  EXPECT_EQ(processes["uniform-grid"], (std::set<std::int64_t>{0, 1, 2}));
  EXPECT_EQ(stops, 1 + 2 * 6);  // one for each set
  EXPECT_TRUE(std::filesystem::exists(out() / "machine.csv"));
}

// What an update does ahead for the frames after it is charged to it.
TEST_F(Runner, SamplesOfUpdatesGoOverAllFrames) {
  const campaign::Campaign c = campaign(
      "broad = ['naive', 'verlet-list']\nnarrow = 'none'\nframes = 8\nseconds = 1e-6\n"
      "squares = 6\nrounds = 1\nprocesses = 1");
  const campaign::RunResult result = campaign::run_campaign(c, out());
  int samples = 0;
  for (const record::RawRow& row : result.findings.rows()) {
    if (row.kind != record::RowKind::sample) continue;
    ++samples;
    EXPECT_GT(row.frames, 0);
    EXPECT_EQ(row.frames % 7, 0) << "the frames after the first, which is built";
  }
  EXPECT_GT(samples, 0);
}

// The campaign has every broad phase with some narrow phases, and every narrow phase with one broad
// phase.
TEST_F(Runner, GivesTheSameAnswersAtEveryWidthInEveryCombination) {
  const campaign::Campaign c = campaign(
      "threads = [1, 3]\npairing = 'product'\nframes = 2\n"
      "tasks = ['intersect', 'distance', 'penetration']\n"
      "seconds = 1e-6\nsquares = 6\nrounds = 1\nprocesses = 1\n"
      "[[group]]\nbroad = 'ours'\nnarrow = ['gjk', 'closed-form']\nscalars = 'double'\n"
      "[[group]]\nbroad = 'packed-rtree'\nnarrow = 'ours'\n");
  const campaign::RunResult result = campaign::run_campaign(c, out());
  EXPECT_FALSE(result.findings.ours_are_wrong()) << record::departures_text(result.findings);
  std::map<std::string, std::set<std::string>> by_cell;
  std::set<std::string> combinations;
  for (const record::RawRow& row : result.findings.rows()) {
    EXPECT_NE(row.status, record::RowStatus::wrong) << record::label_of(row);
    if (row.kind == record::RowKind::sample && row.phase == record::Phase::narrow) {
      combinations.insert(row.broad + " " + row.narrow);
    }
    if (row.kind != record::RowKind::check || row.pair_hash.empty()) continue;
    by_cell[row.broad + row.narrow + (row.is_narrow() ? record::label_of(row) : "") +
            std::string(row.task ? to_string(*row.task) : "") + row.pair_kind +
            std::to_string(row.frame)]
        .insert(row.pair_hash + row.outcome_hash);
  }
  for (const auto& [cell, hashes] : by_cell) EXPECT_EQ(hashes.size(), 1u) << cell;
  EXPECT_GE(combinations.size(), 20u);
}

// Executors are contestants of one set: they share its squares and have the same answers.
TEST_F(Runner, TimesEachAlgorithmOnEachExecutorInTheSameRounds) {
  const campaign::Campaign c = campaign(
      "threads = [1, 2]\nexecutor = ['crew', 'onetbb', 'crew']\nbroad = ['naive', 'packed-rtree']\n"
      "narrow = 'gjk'\nscalars = 'double'\nsquares = 6\nprocesses = 1");
  const campaign::RunResult result = campaign::run_campaign(c, out());
  EXPECT_FALSE(result.findings.ours_are_wrong()) << record::departures_text(result.findings);
  using Squares = std::set<std::pair<std::int64_t, std::int64_t>>;
  std::map<std::string, Squares> squares;
  for (const record::RawRow& row : record::read_rows<record::RawRow>(out() / "raw.csv")) {
    const bool is_sample = row.kind == record::RowKind::sample;
    EXPECT_EQ(row.executor.has_value(), is_sample && row.threads > 1);
    if (!is_sample || row.is_twin() || row.is_narrow()) continue;
    squares[std::to_string(row.threads) + " " + record::label_of(row)].emplace(row.square,
                                                                               row.round);
  }
  using testing::ElementsAre;
  using testing::Key;
  EXPECT_THAT(squares, ElementsAre(Key("1 naive"), Key("1 packed-rtree"), Key("2 naive"),
                                   Key("2 naive onetbb"), Key("2 packed-rtree"),
                                   Key("2 packed-rtree onetbb")));
  const stats::Tables tables = stats::make_tables(stats::read_results(out()), stats::Noise::kept);
  // Two broad phases, and gjk in each of the sets of kinds.
  EXPECT_EQ(tables.executors.size(), 2u + 6u);
  for (const stats::ExecutorRow& row : tables.executors) {
    EXPECT_EQ(row.key.threads, 2);
    EXPECT_EQ(row.executor, ExecutorKind::onetbb);
    EXPECT_EQ(row.base, ExecutorKind::crew);
    EXPECT_GT(row.ratio.median, 0);
  }
  std::set<std::string> sped_up;
  for (const stats::SpeedUpRow& row : tables.speed_ups) {
    if (row.key.threads == 2) sped_up.insert(row.label);
  }
  EXPECT_THAT(sped_up, ElementsAre("gjk double", "gjk double onetbb", "naive", "naive onetbb",
                                   "packed-rtree", "packed-rtree onetbb"));
}

// The check, which has one thread, is that of the algorithm on whichever executor.
TEST_F(Runner, GivesTheChecksToTheOnlyExecutor) {
  const campaign::Campaign c = campaign(
      "executor = 'onetbb'\nlimit = true\nbroad = ['naive', 'packed-rtree']\nnarrow = 'none'\n"
      "squares = 6\nrounds = 1\nprocesses = 1");
  campaign::run_campaign(c, out());
  const stats::Results results = stats::read_results(out());
  ASSERT_EQ(results.sets.size(), 1u);
  std::set<std::string> labels;
  for (const stats::Contestant& contestant : results.sets[0].contestants) {
    labels.insert(contestant.label);
    EXPECT_FALSE(contestant.samples.empty()) << contestant.label;
    EXPECT_FALSE(contestant.checks.empty()) << contestant.label;
  }
  EXPECT_THAT(labels, testing::ElementsAre("limit onetbb", "naive onetbb", "packed-rtree onetbb"));
  const stats::Tables tables = stats::make_tables(results, stats::Noise::kept);
  EXPECT_TRUE(tables.executors.empty());
  ASSERT_EQ(tables.broad_best.size(), 1u);
  EXPECT_GT(tables.broad_best[0].over_limit.median, 0);
  EXPECT_EQ(tables.broad_best[0].peer.label, "") << "the limit is none";
}

// Bodies that come and go, jump or move are checked frame by frame like all others.
TEST_F(Runner, ChecksFramesInWhichBodiesComeAndGo) {
  const campaign::Campaign c =
      campaign("broad = ['ours', 'peers']\nnarrow = 'gjk'\nsquares = 6\nthreads = 2");
  std::ofstream(folder_.path() / "scene.toml")
      << "generator = 'uniform'\ncount = 120\noverlaps = 4\nframes = 7\nchurn = 0.1\n"
         "teleports = 0.1\nmoving = 0.5\n";
  const campaign::RunResult result = campaign::run_campaign(c, out());
  EXPECT_FALSE(result.findings.ours_are_wrong()) << record::departures_text(result.findings);
  std::map<std::int64_t, std::set<std::string>> hashes;
  std::map<std::int64_t, std::set<std::string>> found_by;
  for (const record::RawRow& row : result.findings.rows()) {
    EXPECT_EQ(row.bodies, 120);
    if (row.kind != record::RowKind::check || row.phase != record::Phase::find_pairs) continue;
    const BroadPhaseEntry* const entry = registry::find<BroadPhaseEntry>(row.broad);
    if (!entry->info.known_defect.empty()) continue;
    hashes[row.frame].insert(row.pair_hash);
    found_by[row.frame].insert(row.broad);
  }
  ASSERT_EQ(hashes.size(), 7u);
  std::set<std::string> all;
  for (const auto& [frame, set] : hashes) {
    EXPECT_EQ(set.size(), 1u) << frame;
    EXPECT_GE(found_by[frame].size(), 8u);
    all.insert(set.begin(), set.end());
  }
  EXPECT_EQ(all.size(), 7u) << "every frame has other pairs";
}

TEST_F(Runner, RebuildsHoldsInstructionsDownAndMeasuresTheLimit) {
  const campaign::Campaign c = campaign(
      "broad = ['naive', 'sweep-one-axis']\nnarrow = 'none'\nthreads = 1\nlimit = true\n"
      "isa = ['all', 'baseline']\nsquares = 6\nrounds = 1\nprocesses = 1\n"
      "[[group]]\nrebuild = true\n[[group]]\n");
  const Isa before = isa();
  const campaign::RunResult result = campaign::run_campaign(c, out());
  EXPECT_EQ(isa(), before);
  EXPECT_FALSE(result.findings.ours_are_wrong()) << record::departures_text(result.findings);
  std::map<std::string, std::map<std::string, int>> samples;
  for (const record::RawRow& row : record::read_rows<record::RawRow>(out() / "raw.csv")) {
    EXPECT_EQ(row.status, record::RowStatus::ok);
    EXPECT_EQ(row.isa, row.isa_limit ? Isa::baseline : before);
    if (row.kind != record::RowKind::sample) continue;
    EXPECT_EQ(row.process, 0);
    EXPECT_EQ(row.round, 0);
    EXPECT_NE(row.phase, row.is_rebuilt() ? record::Phase::update : record::Phase::build);
    if (row.phase != record::Phase::find_pairs || row.is_twin()) continue;
    ++samples[std::string(row.isa_limit ? "limited" : "") + (row.is_rebuilt() ? " rebuilt" : "")]
             [row.broad];
  }
  ASSERT_EQ(samples.size(), 4u);
  const std::map<std::string, int> each = {{"naive", 6}, {"sweep-one-axis", 6}, {"limit", 6}};
  for (const auto& [block, counts] : samples) EXPECT_EQ(counts, each) << block;
  // The results have four sets, not one.
  const stats::Results read = stats::read_results(out());
  EXPECT_EQ(read.sets.size(), 4u);
  const stats::Tables tables = stats::make_tables(read, stats::Noise::kept);
  const std::string text = stats::tables_markdown(tables);
  EXPECT_THAT(text, testing::HasSubstr("baseline instructions, rebuilt"));
  EXPECT_THAT(text, testing::ContainsRegex("[|] limit [|] [0-9]"));
  for (const auto& row : tables.winners) EXPECT_NE(row.winner, "limit");
  ASSERT_EQ(tables.broad_best.size(), 4u);
  for (const auto& row : tables.broad_best) {
    EXPECT_NE(row.ours.label, "limit");
    EXPECT_TRUE(row.peer.label.empty());
    EXPECT_GT(row.over_limit.median, 0);
  }
}

TEST_F(Runner, WhoWasTooSlowWithFewerIsNotTriedWithMore) {
  // Time in which another process had the processor does not count, so one frame alone may seem to
  // take none.
  const std::string text =
      "broad = ['naive', 'sweep-one-axis']\nnarrow = 'none'\nthreads = [1, 2]\nsquares = 6\n"
      "counts = [100, 200]\nframes = 20\n";
  const campaign::RunResult all = campaign::run_campaign(campaign(text), out());
  for (const record::RawRow& row : all.findings.rows()) EXPECT_FALSE(row.lost());
  // No algorithm is so fast.
  const campaign::RunResult none =
      campaign::run_campaign(campaign(text + "time_limit = 1e-9"), out());
  int tried = 0, left_out = 0;
  for (const record::RawRow& row : none.findings.rows()) {
    if (!row.lost()) continue;
    EXPECT_EQ(row.status, record::RowStatus::timed_out);
    ++(row.words.empty() ? tried : left_out);
    if (row.words.empty()) continue;
    EXPECT_EQ(row.words, "not tried: over the limit of 1e-09 s with 100 bodies");
  }
  EXPECT_EQ(tried, 2);
  EXPECT_EQ(left_out, 2 * 3) << "the same at two threads, and with more bodies";
  // A limit that grows faster than the count is not skipped.
  const campaign::RunResult more = campaign::run_campaign(
      campaign("broad = 'naive'\nnarrow = 'none'\nthreads = 1\nsquares = 6\nframes = 20\n"
               "[[group]]\ncounts = 100\ntime_limit = 1e-9\n"
               "[[group]]\ncounts = 200\ntime_limit = 10\n"),
      out());
  int lost = 0;
  for (const record::RawRow& row : more.findings.rows()) lost += row.lost();
  EXPECT_EQ(lost, 1);
}

TEST_F(Runner, TablesNameEveryAlgorithm) {
  const campaign::Campaign c = campaign("broad = 'ours'\nnarrow = 'ours'\nseconds = 0.5");
  const campaign::RunResult result = campaign::run_campaign(c, out());
  const stats::Results read = stats::read_results(out());
  const stats::Tables tables = stats::make_tables(read, stats::Noise::kept);
  const std::string text = stats::tables_markdown(tables);
  for (const BroadPhaseEntry* entry : c.groups[0].broad) {
    EXPECT_THAT(text, testing::HasSubstr("| " + entry->info.name + " |"));
  }
  // These are the narrow phases that take a pair of kinds of the scene.
  constexpr std::array kinds = {ShapeKind::sphere, ShapeKind::box, ShapeKind::hull};
  for (const measure::NarrowChoice& choice : c.groups[0].narrow) {
    bool takes_some = false;
    for (const ShapeKind a : kinds) {
      for (const ShapeKind b : kinds) {
        takes_some = takes_some || offers(*choice.entry, a, b, Task::intersect);
      }
    }
    EXPECT_EQ(text.find("| " + choice.label() + " |") != std::string::npos, takes_some)
        << choice.entry->info.name;
  }
  EXPECT_THAT(text, testing::HasSubstr("## Winner against runner-up"));
  EXPECT_THAT(text, testing::HasSubstr("## Agreement with the exact answers"));
  const std::string summary = stats::summary(read, tables, result.findings.departures(), out(),
                                             {.noise = stats::Noise::kept});
  EXPECT_LE(std::ranges::count(summary, '\n'), 25) << summary;
  EXPECT_THAT(summary, testing::ContainsRegex("scene +[0-9]+ +"));
  EXPECT_THAT(summary, testing::ContainsRegex("by pairs +boxes .*, intersect "));
}

TEST_F(Runner, LeavesNothingBehindWhenASceneIsWrong) {
  campaign::Campaign c = campaign("");
  std::ofstream(folder_.path() / "scene.toml") << "generator = 'uniform'\ncount = -3\n";
  EXPECT_THROW(campaign::run_campaign(c, out()), base::InputError);
  EXPECT_FALSE(std::filesystem::exists(out()));
}

TEST_F(Runner, LeavesOutWhatIsTooSlowAndSaysSo) {
  const campaign::Campaign c = campaign("broad = 'naive'\nnarrow = 'none'\ntime_limit = 1e-9");
  const campaign::RunResult result = campaign::run_campaign(c, out());
  int lost = 0;
  for (const record::RawRow& row : result.findings.rows())
    lost += row.status == record::RowStatus::timed_out;
  EXPECT_EQ(lost, 1);
  EXPECT_FALSE(result.findings.ours_are_wrong());
  EXPECT_THAT(record::departures_text(result.findings), testing::HasSubstr("over the limit"));
}

TEST_F(Runner, RulesLeaveCellsOut) {
  const campaign::Campaign c = campaign(
      "broad = ['naive', 'uniform-grid']\nnarrow = ['gjk', 'sat']\ncounts = [30, 60]\n"
      "exclude = [{broad = 'naive', counts_above = 40}, {narrow = 'gjk', scalar = 'float'},\n"
      "           {narrow = 'sat', pair_kind = 'box-box'}]\nseconds = 0.05");
  const campaign::RunResult result = campaign::run_campaign(c, out());
  std::set<std::string> cells;
  for (const record::RawRow& row : result.findings.rows()) {
    if (row.status == record::RowStatus::unsupported) continue;
    cells.insert(record::label_of(row) + " " + std::to_string(row.bodies) + " " + row.pair_kind);
  }
  EXPECT_TRUE(cells.contains("naive 30 "));
  EXPECT_FALSE(cells.contains("naive 60 "));
  EXPECT_TRUE(cells.contains("uniform-grid 60 "));
  EXPECT_TRUE(cells.contains("gjk double 60 box-box"));
  EXPECT_FALSE(cells.contains("gjk float 60 box-box"));
  EXPECT_FALSE(cells.contains("sat double 60 box-box"));
  EXPECT_TRUE(cells.contains("sat double 60 box-hull"));
  const std::vector<campaign::PlannedBlock> plan = campaign::plan_campaign(c);
  ASSERT_EQ(plan.size(), 2u);
  EXPECT_THAT(plan[1].sets[0].contestants, testing::ElementsAre("uniform-grid"));
}

}  // namespace
