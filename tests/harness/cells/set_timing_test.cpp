// Tests of the measuring of timed sets: contestants that crash, hang or change their answers cost
// themselves alone; the twin, the squares, and a run that was stopped.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <thread>

#include "harness/cells/cell_run.h"
#include "harness/cells/set_timing.h"
#include "harness/files/text_file.h"
#include "harness/record/raw_row.h"
#include "harness/stats/cell_results.h"
#include "harness/stats/cell_rows.h"
#include "harness/stats/cell_tables.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// A contestant whose answer is a number; `act(call)` is done in each call, and may change it. Calls are
// counted in each process: two when it is graded, one or more of the warm-up, then one a sample.
kinds::TimedContestant planted(
    const std::string& name, std::function<int(int call)> act = [](int) { return 0; },
    Origin origin = Origin::ours) {
  struct State {
    int calls = 0, answer = 0;
  };
  const auto state = std::make_shared<State>();
  kinds::TimedContestant made;
  made.name = name;
  made.origin = origin;
  made.answer = [=] { state->answer = act(++state->calls); };
  made.grade = [] { return kinds::TimedGrade{}; };
  made.hash = [=] { return static_cast<std::uint64_t>(state->answer); };
  return made;
}

cells::CellRequest planted_request(std::vector<kinds::TimedContestant> contestants) {
  cells::CellRequest request;
  request.name = "planted";
  request.query_kind = "point";
  request.rounds = 12;
  request.sample_seconds = 1e-12;  // one answer a sample
  request.time_limit = 4;
  request.cells.push_back(
      {"input", "family",
       [=] { return kinds::TimedSet{.queries = 3, .graded = 3, .contestants = contestants}; }});
  return request;
}

struct TimedRun {
  cells::CellRunResult result;
  std::vector<record::RawRow> rows;
  std::map<std::string, stats::CellTimeRow> times;
};
TimedRun time_sets(const cells::CellRequest& request, const std::filesystem::path& out,
                   record::FolderStart start = record::FolderStart::overwrite) {
  TimedRun ran;
  ran.result = cells::run_cells(request, out, start, [](const auto&) {});
  ran.rows = record::read_rows<record::RawRow>(out / "raw.csv");
  if (ran.result.interrupted) return ran;
  stats::write_cell_tables(out, request.name, out);
  for (const auto& row : record::read_rows<stats::CellTimeRow>(out / "set_times.csv"))
    ran.times[row.grade.algorithm] = row;
  return ran;
}

std::vector<record::RawRow> rows_of(const TimedRun& ran, const std::string& algorithm) {
  std::vector<record::RawRow> rows;
  for (const record::RawRow& row : ran.rows)
    if (row.algorithm == algorithm && !row.is_twin()) rows.push_back(row);
  return rows;
}

// Samples in which nothing went wrong.
std::int64_t samples_of(const TimedRun& ran, const std::string& algorithm) {
  return std::ranges::count_if(rows_of(ran, algorithm),
                               [](const record::RawRow& row) { return row.seconds >= 0; });
}

TEST(SetTiming, WhatFailsInASampleCostsItsContestantAlone) {
  const TemporaryFolder folder;
  const auto crash = [](int call) {
    if (call == 4) raise(SIGSEGV);
    return 0;
  };
  const auto hang = [](int call) {
    if (call == 3) std::this_thread::sleep_for(std::chrono::hours(1));
    return 0;
  };
  const auto change = [](int call) { return call < 4 ? 0 : 1; };
  const TimedRun ran =
      time_sets(planted_request({planted("sound"), planted("crash", crash), planted("hang", hang),
                                 planted("change", change), planted("other")}),
                folder.path() / "out");
  EXPECT_TRUE(ran.result.ours_wrong);
  const std::map<std::string, record::RowStatus> expected = {{"crash", record::RowStatus::crashed},
                                                             {"hang", record::RowStatus::timed_out},
                                                             {"change", record::RowStatus::wrong}};
  for (const auto& [name, status] : expected) {
    const std::vector<record::RawRow> rows = rows_of(ran, name);
    ASSERT_FALSE(rows.empty()) << name;
    EXPECT_EQ(rows.back().status, status) << name;
    EXPECT_FALSE(rows.back().words.empty()) << name;
    // One answer is the warm-up; it fails in its second or third sample, and has none after that.
    EXPECT_EQ(samples_of(ran, name), name == "hang" ? 1 : 2) << name;
    EXPECT_EQ(rows.size(), samples_of(ran, name) + 1U) << name;
    EXPECT_EQ(ran.times.at(name).grade.status, to_string(status)) << name;
    EXPECT_TRUE(std::isnan(ran.times.at(name).seconds)) << name;
  }
  for (const char* name : {"sound", "other"}) {
    EXPECT_EQ(samples_of(ran, name), 12) << name;
    EXPECT_EQ(ran.times.at(name).grade.status, "ok");
    EXPECT_GT(ran.times.at(name).seconds, 0);
  }
}

TEST(SetTiming, AContestantThatIsLostInItsWarmUpIsARow) {
  const TemporaryFolder folder;
  // Another answer when it is called first: the graded one is the second.
  const TimedRun ran = time_sets(
      planted_request({planted("sound"), planted("first", [](int call) { return call; })}),
      folder.path() / "out");
  const std::vector<record::RawRow> rows = rows_of(ran, "first");
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].status, record::RowStatus::wrong);
  EXPECT_EQ(rows[0].square, -1);
  EXPECT_EQ(samples_of(ran, "sound"), 12);
}

TEST(SetTiming, TheFirstOfOursHasATwinAndSquaresAreLatin) {
  const TemporaryFolder folder;
  const TimedRun ran = time_sets(planted_request({planted(
                                                      "peer", [](int) { return 0; }, Origin::peer),
                                                  planted("ours")}),
                                 folder.path() / "out");
  EXPECT_FALSE(ran.result.ours_wrong);
  std::set<std::int64_t> processes;
  std::map<std::pair<std::int64_t, std::int64_t>, std::set<std::int64_t>> positions;
  std::int64_t twins = 0;
  for (const record::RawRow& row : ran.rows) {
    if (row.is_twin()) {
      ++twins;
      EXPECT_EQ(row.algorithm, "ours");
    }
    EXPECT_EQ(row.query_kind, "point");
    EXPECT_EQ(row.input, "input");
    EXPECT_EQ(row.family, "family");
    EXPECT_EQ(row.pair_count, 3);
    EXPECT_EQ(row.repeats, 1);
    EXPECT_FALSE(row.boxes);
    processes.insert(row.process);
    positions[{row.square, row.round}].insert(row.position);
  }
  EXPECT_EQ(twins, 12);
  EXPECT_EQ(ran.rows.size(), 36U);
  EXPECT_THAT(processes, ElementsAre(0, 1, 2));
  EXPECT_EQ(positions.size(), 12U);
  for (const auto& [round, places] : positions) EXPECT_EQ(places.size(), 3U);
  EXPECT_EQ(ran.rows.back().stop, "rounds");
  const auto best = record::read_rows<stats::CellBestRow>(folder.path() / "out" / "set_best.csv");
  ASSERT_EQ(best.size(), 1U);
  EXPECT_EQ(best[0].baseline, "ours");
  EXPECT_GT(best[0].twin, 0);
  EXPECT_GT(best[0].ratio, 0);
  // `compare` finds the twin, too.
  const stats::Results results = stats::read_cell_results(folder.path() / "out");
  ASSERT_EQ(results.sets.size(), 1U);
  EXPECT_EQ(results.sets[0].contestants.size(), 2U);
  EXPECT_EQ(results.sets[0].twin.samples.size(), 12U);
}

TEST(SetTiming, SquaresGiveAboutAsManySamplesAsRounds) {
  for (const int rounds : {6, 7, 12, 30, 100}) {
    for (const std::size_t contestants : {2U, 3U, 5U, 12U, 40U}) {
      const cells::SquarePlan plan = cells::square_plan(rounds, contestants);
      EXPECT_GE(plan.squares, 6);
      EXPECT_LE(plan.rounds, contestants);
      const auto samples = static_cast<int>(plan.rounds) * plan.squares;
      EXPECT_GE(samples, rounds) << contestants;
      EXPECT_LE(samples, rounds + plan.squares) << contestants;
    }
  }
}

TEST(SetTiming, ARunThatWasStoppedGoesOnBehindWholeRounds) {
  const TemporaryFolder folder;
  const std::filesystem::path out = folder.path() / "out";
  const pid_t self = getpid();
  // The second sample of each process of `stops` interrupts the run, while the file is there.
  const std::filesystem::path armed = folder.write("armed", "");
  const auto interrupt = [=](int call) {
    if (call == 3 && getppid() == self && std::filesystem::exists(armed)) kill(self, SIGINT);
    return 0;
  };
  const cells::CellRequest request =
      planted_request({planted("sound"), planted("stops", interrupt), planted("other")});
  const TimedRun stopped = time_sets(request, out);
  EXPECT_TRUE(stopped.result.interrupted);
  EXPECT_EQ(stopped.rows.size(), 8U) << "two whole rounds of three contestants and a twin";
  const std::string before = files::read_text(out / "raw.csv");
  const std::string grades = files::read_text(out / "set_grades.csv");
  std::filesystem::remove(armed);
  const TimedRun resumed = time_sets(request, out, record::FolderStart::resume);
  EXPECT_FALSE(resumed.result.interrupted);
  EXPECT_TRUE(files::read_text(out / "raw.csv").starts_with(before));
  EXPECT_EQ(files::read_text(out / "set_grades.csv"), grades);
  EXPECT_EQ(resumed.rows.size(), 12U * 4);
  std::set<std::tuple<std::int64_t, std::int64_t, std::int64_t>> places;
  for (const record::RawRow& row : resumed.rows)
    places.emplace(row.square, row.round, row.position);
  EXPECT_EQ(places.size(), 12U * 4);
  EXPECT_EQ(samples_of(resumed, "stops"), 12);
}

// What crashed before the stop does not come back.
TEST(SetTiming, WhatWasLostStaysLostWhenTheRunGoesOn) {
  const TemporaryFolder folder;
  const std::filesystem::path out = folder.path() / "out";
  const pid_t self = getpid();
  const std::filesystem::path armed = folder.write("armed", "");
  const auto fail = [=](int call) {
    if (call == 3 && getppid() == self && std::filesystem::exists(armed)) raise(SIGSEGV);
    return 0;
  };
  const auto interrupt = [=](int call) {
    if (call == 3 && getppid() == self && std::filesystem::exists(armed)) kill(self, SIGINT);
    return 0;
  };
  const cells::CellRequest request =
      planted_request({planted("sound"), planted("stops", interrupt), planted("lost", fail)});
  EXPECT_TRUE(time_sets(request, out).result.interrupted);
  std::filesystem::remove(armed);
  const TimedRun resumed = time_sets(request, out, record::FolderStart::resume);
  EXPECT_TRUE(resumed.result.ours_wrong) << "the crash of the first part counts";
  EXPECT_EQ(samples_of(resumed, "lost"), 1);
  EXPECT_EQ(rows_of(resumed, "lost").size(), 2U);
  EXPECT_EQ(samples_of(resumed, "sound"), 12);
}

}  // namespace
}  // namespace touchstone
