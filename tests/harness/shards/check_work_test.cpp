// Tests that checks in shards leave what they leave in one piece.
#include <gmock/gmock.h>

#include <sstream>

#include "harness/check/check_file.h"
#include "harness/record/machine.h"
#include "tests/harness/input_fault.h"
#include "tests/harness/shards/planned.h"
#include "tests/harness/stopped_folder.h"

namespace touchstone {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr const char* small_count = R"(
name = "small"
[soak]
narrow = ["certified", "gjk"]
scalars = "double"
pairs = 14_000
regimes = ["gap-1e-3", "depth-1e-3", "touching-grid"]
)";
constexpr const char* small_check = R"(
[check]
narrow = ["certified", "mpr"]
broad = "naive"
cases = 5
rounds = 3
regimes = ["gap-1e-3", "touching-grid"]
)";
constexpr const char* small_axes = R"(
[stress]
narrow = "gjk"
axes = ["gap", "depth"]
cases = 2
)";

class CheckShards : public Planned {
 protected:
  // Does the work in one piece.
  void run_whole() {
    check::CheckFile file = check::read_check_file(folder_.path() / "work.toml");
    file.request.out = folder_.path() / "whole";
    whole_text_ = check::run_and_tell(file.request).text;
  }
  void expect_same(const std::string& name) const {
    EXPECT_EQ(folder_.read("out/" + name), folder_.read("whole/" + name)) << name;
    EXPECT_GT(folder_.read("out/" + name).size(), 100u) << name;
  }

  static std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
  }

  std::string whole_text_;
};

TEST_F(CheckShards, CountsInAnyOrder) {
  make(small_count, 4);
  for (const std::int64_t shard : {2, 0, 3, 1}) run(shard);
  const shards::MergeResult result = merge();
  ASSERT_THAT(result.missing, IsEmpty());
  EXPECT_FALSE(result.merged.ours_wrong);
  run_whole();
  EXPECT_EQ(result.merged.text, whole_text_);
  for (const char* name : {"jobs.csv", "soak.csv"}) expect_same(name);
}

TEST_F(CheckShards, ACheckOfSeveralRounds) {
  make(small_check, 5);
  for (std::int64_t shard = 0; shard < 5; ++shard) run(shard);
  const shards::MergeResult result = merge();
  ASSERT_THAT(result.missing, IsEmpty());
  run_whole();
  for (const char* name : {"grades.csv", "variants.csv", "jobs.csv", "summary.csv"})
    expect_same(name);
}

TEST_F(CheckShards, Axes) {
  make(small_axes, 3);
  for (std::int64_t shard = 0; shard < 3; ++shard) run(shard);
  ASSERT_THAT(merge().missing, IsEmpty());
  run_whole();
  for (const char* name : {"stress.csv", "cells.csv", "envelope.csv"}) expect_same(name);
}

TEST_F(CheckShards, RowsMayBePacked) {
  make(small_count, 2);
  run(0);
  run(1);
  ASSERT_THAT(merge().missing, IsEmpty());
  const auto rows = [&](const char* name) {
    std::vector<std::string> lines;
    files::CsvReader(out() / name, {"algorithm", "pairs"}).read([&](const auto& row) {
      lines.push_back(std::string(row.text(0)) + std::string(row.text(1)));
    });
    return lines;
  };
  const std::vector<std::string> plain = rows("jobs.csv");
  ASSERT_THAT(shards::merge_plan(plan(), out(), {.zstd = true}).missing, IsEmpty());
  EXPECT_FALSE(std::filesystem::exists(out() / "jobs.csv"));
  EXPECT_EQ(rows("jobs.csv.zst"), plain);
  EXPECT_TRUE(std::filesystem::exists(out() / "soak.csv"));
}

TEST_F(CheckShards, AShardThatIsDoneIsNotDoneAgain) {
  make(small_count, 2);
  run(1);
  EXPECT_EQ(shards::run_shard(plan(), 1, 1), shards::ShardEnd::was_done);
  EXPECT_EQ(shards::read_attempts(shards::shard_path(plan(), 1)).size(), 2u);
}

TEST_F(CheckShards, WhatIsMissingIsToldAndNothingIsWritten) {
  make(small_count, 5);
  run(1);
  const shards::MergeResult result = merge();
  EXPECT_EQ(result.missing.size(), 4u);
  EXPECT_EQ(result.missing_list, "0,2-4");
  EXPECT_THAT(result.missing.front(), HasSubstr("shard 0 is to come"));
  EXPECT_FALSE(result.written);
  EXPECT_FALSE(std::filesystem::exists(out()));
}

TEST_F(CheckShards, WhatIsDoneIsJoinedWhereThatIsAsked) {
  make(small_count, 7);
  shards::MergeResult result = shards::merge_plan(plan(), out(), {.partial = true});
  EXPECT_FALSE(result.written);  // no shard is done
  EXPECT_FALSE(std::filesystem::exists(out()));
  run(5);
  run(1);
  result = shards::merge_plan(plan(), out(), {.partial = true});
  EXPECT_TRUE(result.written);
  EXPECT_EQ(result.missing_list, "0,2-4,6");
  record::Facts facts = record::read_facts(out() / "machine.csv");
  EXPECT_EQ(record::value_of(facts, "missing"), "0,2-4,6");
  EXPECT_EQ(record::value_of(facts, record::finished_fact), "no");
  // The rows of both shards, each of two jobs of a thousand pairs for two algorithms.
  run_whole();
  const std::vector<std::string> rows = lines_of(folder_.read("out/jobs.csv"));
  const std::vector<std::string> whole = lines_of(folder_.read("whole/jobs.csv"));
  const std::size_t of_shard = (whole.size() - 1) / 7;
  ASSERT_EQ(rows.size(), 1 + 2 * of_shard);
  for (std::size_t i = 0; i < of_shard; ++i) {
    EXPECT_EQ(rows[1 + i], whole[1 + of_shard + i]);
    EXPECT_EQ(rows[1 + of_shard + i], whole[1 + 5 * of_shard + i]);
  }
  EXPECT_NE(result.merged.text, whole_text_);
  for (const std::int64_t shard : {0, 2, 3, 4, 6}) run(shard);
  result = merge();
  EXPECT_TRUE(result.written);
  EXPECT_EQ(result.merged.text, whole_text_);
  facts = record::read_facts(out() / "machine.csv");
  EXPECT_EQ(record::value_of(facts, "missing"), "");
  EXPECT_EQ(record::value_of(facts, record::finished_fact), "yes");
}

TEST_F(CheckShards, APartThatWasStoppedGoesOn) {
  make(small_count, 2);
  run(0);
  run(1);
  const std::string done = folder_.read("plan/shards/0/0/part-0-7/jobs.csv");
  // As a kill leaves it: half a row more than progress.csv knows, and no end of the attempt.
  const std::string name = "plan/shards/0/0/part-0-7/";
  std::size_t end = 0;
  for (int line = 0; line < 5; ++line) end = done.find('\n', end) + 1;
  stop_folder(part(0, 0, 7), 2,
              {{"jobs.csv", end}, {"families.csv", folder_.read(name + "families.csv").size()}});
  folder_.write(name + "jobs.csv", done.substr(0, end + 20));
  std::string attempts = folder_.read("plan/shards/0/0/attempts.csv");
  attempts.resize(attempts.find("\n", attempts.find("begun")) + 1);
  folder_.write("plan/shards/0/0/attempts.csv", attempts + "1,beg");
  const shards::ShardPlan read = shards::read_plan(plan());
  EXPECT_EQ(status_of(read, 0).state, shards::ShardState::failed);
  run(0);
  EXPECT_EQ(folder_.read(name + "jobs.csv"), done);
  EXPECT_EQ(status_of(read, 0).state, shards::ShardState::done);
}

TEST_F(CheckShards, RowsThatAreNotThoseOfThePlanAreRefused) {
  make(small_count, 2);
  run(0);
  run(1);
  const std::string machine = folder_.read("plan/shards/0/0/part-0-7/machine.csv");
  const auto refused = [&](const std::string& from, const std::string& to) {
    edit(part(0, 0, 7) / "machine.csv", from, to);
    const std::string fault = input_fault([&] { merge(); });
    EXPECT_FALSE(std::filesystem::exists(out()));
    folder_.write("plan/shards/0/0/part-0-7/machine.csv", machine);
    return fault;
  };
  EXPECT_THAT(refused("finished,yes", "finished,no"), HasSubstr("finished is 'no'"));
  EXPECT_THAT(refused("plan,", "plan,f"), HasSubstr("plan is 'f"));
  EXPECT_THAT(refused("part,0-7", "part,7-14"), HasSubstr("part is '7-14'; expected '0-7'"));
  EXPECT_THAT(refused("shard,0", "shard,1"), HasSubstr("shard is '1'"));
  // A file that was cut, or that has more rows than were written.
  const std::string jobs = folder_.read("plan/shards/0/0/part-0-7/jobs.csv");
  for (const std::string& other : {jobs.substr(0, jobs.size() - 1), jobs + jobs.substr(100, 50)}) {
    folder_.write("plan/shards/0/0/part-0-7/jobs.csv", other);
    EXPECT_THAT(input_fault([&] { merge(); }), HasSubstr("jobs.csv: "));
  }
  folder_.write("plan/shards/0/0/part-0-7/jobs.csv", jobs);
  EXPECT_THAT(merge().missing, IsEmpty());
}

TEST_F(CheckShards, RowsThatWereReplacedAreRefused) {
  make(small_count, 2);
  run(0);
  run(1);
  const std::string name = "plan/shards/0/0/part-0-7/";
  const std::string jobs = folder_.read(name + "jobs.csv");
  // One regime twice and another never: as many rows, of the same length.
  std::string other = jobs;
  for (std::size_t at = 0; (at = other.find("depth-1e-3", at)) != std::string::npos;)
    other.replace(at, 10, "gap-1e-3  ");
  ASSERT_NE(other, jobs);
  folder_.write(name + "jobs.csv", other);
  EXPECT_THAT(input_fault([&] { merge(); }),
              HasSubstr(name + "jobs.csv: its first " + std::to_string(jobs.size()) + " bytes"));
  // The rows and the progress of another shard.
  for (const char* file : {"jobs.csv", "progress.csv"})
    folder_.write(name + file, folder_.read("plan/shards/0/1/part-7-14/" + std::string(file)));
  EXPECT_THAT(input_fault([&] { merge(); }), HasSubstr("hash"));
  EXPECT_FALSE(std::filesystem::exists(out()));
}

TEST_F(CheckShards, AHostThatIsAPathIsRefused) {
  make(small_count, 1);
  run(0);
  edit(part(0, 0, 14) / "machine.csv", "host," + shards::host_name(), "host,../../away");
  EXPECT_THAT(input_fault([&] { merge(); }), HasSubstr("host: found '../../away'; expected"));
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "away"));
}

TEST_F(CheckShards, AFactOfThePlanThatWasChangedIsRefused) {
  make(small_count, 2);
  edit(plan() / "plan.csv", "work,program,", "work,program,0");
  EXPECT_THAT(input_fault([&] { shards::run_shard(plan(), 0, 1); }),
              HasSubstr("is of another plan than the files beside it"));
}

TEST_F(CheckShards, AnotherProgramIsRefused) {
  make(small_count, 2);
  record::Facts planned = shards::read_plan(plan()).identity;
  const std::unique_ptr<shards::Work> work = shards::read_work(folder_.path() / "work.toml");
  EXPECT_EQ(input_fault([&] { work->expect_planned(planned, {0, 7}); }), "");
  for (auto& [name, value] : planned) {
    if (name == "program") value = "another";
  }
  EXPECT_THAT(input_fault([&] {
                work->expect_planned(planned, {0, 7});
              }),
              HasSubstr("was 'another' when the plan was made; expected the same build"));
}

TEST_F(CheckShards, ResultsOfOtherWorkAreNotReplaced) {
  make(small_count, 1);
  run(0);
  std::filesystem::create_directory(out());
  folder_.write("out/mine.txt", "mine");
  EXPECT_THAT(input_fault([&] { merge(); }), HasSubstr("expected another --out, or --overwrite"));
  EXPECT_EQ(folder_.read("out/mine.txt"), "mine");
  shards::merge_plan(plan(), out(), {.overwrite = true});
  EXPECT_EQ(folder_.read("out/mine.txt"), "mine");  // what nobody's results need stays
  EXPECT_THAT(merge().missing, IsEmpty());          // those of the plan are replaced without a word
  EXPECT_EQ(folder_.read("out/mine.txt"), "mine");
  EXPECT_THAT(folder_.names(), ::testing::ElementsAre("out", "plan", "work.toml"));
}

}  // namespace
}  // namespace touchstone
