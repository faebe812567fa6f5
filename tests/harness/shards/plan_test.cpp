// Tests that plans are whole, and that what is wrong with one is told.
#include <gmock/gmock.h>
#include <sys/stat.h>

#include <cstdlib>

#include "tests/harness/input_fault.h"
#include "tests/harness/shards/planned.h"

namespace touchstone {
namespace {

using ::testing::HasSubstr;

constexpr const char* soak = "[soak]\npairs = 5_000\nregimes = \"gap-1e-3\"\n";

class ShardPlans : public Planned {};

TEST_F(ShardPlans, HasItsScriptsAndACopyOfTheWork) {
  const shards::ShardPlan made = make(soak, 3);
  EXPECT_EQ(folder_.read("plan/campaign/work.toml"), soak);
  EXPECT_THAT(folder_.read("plan/plan.sh"), HasSubstr("SHARDS=3\n"));
  for (const char* script : {"slurm.sh", "parallel.sh"}) {
    const auto permissions = std::filesystem::status(plan() / script).permissions();
    EXPECT_NE(permissions & std::filesystem::perms::owner_exec, std::filesystem::perms::none);
  }
  const shards::ShardPlan read = shards::read_plan(plan());
  EXPECT_EQ(read.id, made.id);
  EXPECT_EQ(read.identity, made.identity);
  ASSERT_EQ(read.shards.size(), 3u);
  EXPECT_EQ(read.shards.back().units.end, 5);
}

TEST_F(ShardPlans, TheWorkMayChangeAfterwards) {
  make(soak, 2);
  folder_.write("work.toml", "[soak]\npairs = 9_000\n");
  run(0);
  run(1);
  EXPECT_TRUE(merge().missing.empty());
}

TEST_F(ShardPlans, WhatIsWrongIsToldWithItsPlace) {
  const auto fault = [&](const std::string& toml, std::int64_t shards) {
    return folder_.without_path(input_fault([&] { make(toml, shards); }));
  };
  EXPECT_THAT(fault(soak, 6), HasSubstr("work.toml: has 5 parts that can be done apart"));
  EXPECT_THAT(fault("[soak]\npair = 3\n", 1), HasSubstr("work.toml:2: soak: unknown key pair"));
  EXPECT_THAT(fault("[soak]\nregimes = \"flat\"\n", 1),
              HasSubstr("work.toml:2: soak: regimes: no regime is called 'flat'"));
  EXPECT_THAT(fault("[check]\n[soak]\n", 1), HasSubstr("unknown key soak"));
  EXPECT_THAT(fault("[stress]\naxes = \"up\"\n", 1), HasSubstr("no axis is called 'up'"));
  EXPECT_THAT(fault("[soak]\nscalars = \"half\"\n", 1), HasSubstr("expected one of float, double"));
  EXPECT_FALSE(std::filesystem::exists(plan()));
}

TEST_F(ShardPlans, APlanIsNotReplaced) {
  make(soak, 2);
  EXPECT_THAT(input_fault([&] { make(soak, 3); }), HasSubstr("is the plan of other work"));
}

TEST_F(ShardPlans, APlanThatWasNotFinishedIsNone) {
  make(soak, 2);
  std::filesystem::remove(plan() / "plan.csv");
  EXPECT_THAT(input_fault([&] { shards::read_plan(plan()); }), HasSubstr("holds no whole plan"));
  make(soak, 2);
}

TEST_F(ShardPlans, FilesOfAnotherPlanAreRefused) {
  make(soak, 2);
  edit(plan() / "shards.csv", "0,0,", "0,1,");
  EXPECT_THAT(input_fault([&] { shards::read_plan(plan()); }),
              HasSubstr("is of another plan than the files beside it"));
}

TEST_F(ShardPlans, AShardThatThereIsNot) {
  make(soak, 2);
  EXPECT_THAT(input_fault([&] { shards::run_shard(plan(), 2, 1); }),
              HasSubstr("has the shards 0 to 1; expected one of them, and not 2"));
}

TEST_F(ShardPlans, ASecondProcessIsToldWhoDoesTheShard) {
  make(soak, 2);
  shards::ShardLock lock(shards::shard_path(plan(), 0), 0);
  lock.begin();
  EXPECT_EQ(status_of(shards::read_plan(plan()), 0).state, shards::ShardState::running);
  EXPECT_THAT(input_fault([&] { shards::run_shard(plan(), 0, 1); }),
              HasSubstr("shard 0 is being done on " + shards::host_name() + " by process " +
                        std::to_string(getpid())));
}

TEST_F(ShardPlans, TheStateSaysWhoFailedAndWhy) {
  make(soak, 4);
  run(0);
  const auto attempt = [&](std::int64_t shard) {
    return std::make_unique<shards::ShardLock>(shards::shard_path(plan(), shard), shard);
  };
  attempt(1)->begin();  // killed
  auto failed = attempt(2);
  failed->begin();
  failed->end(shards::Event::failed, "no\nspace");
  failed.reset();
  const shards::ShardPlan read = shards::read_plan(plan());
  const shards::PlanStatus status = status_of(read);
  EXPECT_THAT(status.counts, ::testing::ElementsAre(1, 0, 2, 1));
  const std::string text = status_text(read, status);
  EXPECT_THAT(text, HasSubstr("1 done, 0 running, 2 failed, 1 to come"));
  EXPECT_THAT(text, HasSubstr("killed, or its machine went down"));
  EXPECT_THAT(text, HasSubstr("failed: no space"));
  EXPECT_THAT(text, HasSubstr("slurm.sh 1-2"));
}

// Whoever can write into the plan can name any file as a log.
TEST_F(ShardPlans, OnlyALogInThePlanIsRead) {
  make(soak, 2);
  const auto words = [&](const std::filesystem::path& log) {
    setenv("TOUCHSTONE_LOG", log.c_str(), 1);
    auto lock = std::make_unique<shards::ShardLock>(shards::shard_path(plan(), 1), 1);
    lock->begin();
    lock->end(shards::Event::failed, "fault");
    lock.reset();
    unsetenv("TOUCHSTONE_LOG");
    return status_of(shards::read_plan(plan()), 1).words;
  };
  folder_.write("secret", "from elsewhere\n");
  folder_.write("plan/logs/own", "from here\n");
  EXPECT_EQ(words(plan() / "logs/own"), "failed: fault; its last words: from here");
  EXPECT_EQ(words(folder_.path() / "secret"), "failed: fault");
  EXPECT_EQ(words(plan() / "logs/../../secret"), "failed: fault");
  std::filesystem::create_symlink(folder_.path() / "secret", plan() / "logs/link");
  EXPECT_EQ(words(plan() / "logs/link"), "failed: fault");
  ASSERT_EQ(mkfifo((plan() / "logs/pipe").c_str(), 0600), 0);
  EXPECT_EQ(words(plan() / "logs/pipe"), "failed: fault");  // nobody writes to it
}

TEST_F(ShardPlans, NamesThatLeaveThePlanAreRefused) {
  make(soak, 2);
  const std::string whole = folder_.read("plan/plan.csv");
  const auto refused = [&](const std::string& from, const std::string& to) {
    edit(plan() / "plan.csv", from, to);
    const std::string fault = input_fault([&] { shards::read_plan(plan()); });
    folder_.write("plan/plan.csv", whole);
    return folder_.without_path(fault);
  };
  EXPECT_THAT(refused("file,work.toml", "file,../../work.toml"),
              HasSubstr("plan/plan.csv:5: file: found '../../work.toml'; expected"));
  EXPECT_THAT(refused("name,work", "name,\033]0;title\007"),
              HasSubstr("plan/plan.csv:4: name: found '?]0;title?'; expected"));
}

TEST_F(ShardPlans, AFolderThatCannotBeWrittenIsFoundBeforeTheTrials) {
  folder_.write("plan", "a file");
  EXPECT_THAT(input_fault([&] { make(soak, 2); }), HasSubstr("is no folder"));
}

TEST(ListOf, JoinsNeighbours) {
  EXPECT_EQ(shards::list_of({}), "");
  EXPECT_EQ(shards::list_of({3, 17, 18, 19, 21}), "3,17-19,21");
}

}  // namespace
}  // namespace touchstone
