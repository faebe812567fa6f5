// Tests that campaigns and trades in shards leave what they leave in one piece, and that the times of
// several machines are not mixed.
#include <gmock/gmock.h>

#include "harness/campaign/runner.h"
#include "harness/measure/noise.h"
#include "harness/stats/machines.h"
#include "tests/harness/input_fault.h"
#include "tests/harness/shards/planned.h"

namespace touchstone {
namespace {

using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

// The faces alone do not tell all pairs of boxes apart, so that there are departures.
constexpr const char* small_campaign = R"(
name = "small"
scenes = "scene.toml"
seeds = [1, 2]
counts = [20, 30]
threads = 1
broad = ["naive", "sweep-one-axis"]
narrow = ["gjk", "sat-faces"]
scalars = "double"
squares = 6
processes = 1
seconds = 0.02
width = 10
)";
constexpr const char* small_scene = R"(
generator = "uniform"
count = 20
overlaps = 4
frames = 2
shapes = ["box"]
)";

class CampaignShards : public Planned {
 protected:
  // Other work of the machine would leave too few rounds for a ratio.
  CampaignShards() {
    measure::noise_judge() = [](const measure::NoiseReading&, const measure::NoiseReading&, double,
                                double) { return std::string(); };
  }
  ~CampaignShards() override { measure::noise_judge() = &measure::noise_flags; }

  void plan_campaign(std::int64_t shards) {
    folder_.write("scene.toml", small_scene);
    make(small_campaign, shards);
  }
  std::vector<record::RawRow> rows(const std::string& of) const {
    return record::read_rows<record::RawRow>(folder_.path() / of / "raw.csv");
  }
  // Makes the parts of a shard look as if another machine had measured them.
  void move_to(const std::string& host, const shards::PlannedShard& shard) {
    for (std::int64_t block = shard.units.first; block < shard.units.end; ++block) {
      edit(part(shard.shard, block, block + 1) / "machine.csv", "host," + shards::host_name(),
           "host," + host);
    }
  }
};

TEST_F(CampaignShards, HaveTheRowsOfOneRun) {
  plan_campaign(3);
  for (const std::int64_t shard : {1, 2, 0}) run(shard);
  const shards::MergeResult result = merge();
  ASSERT_THAT(result.missing, IsEmpty());
  campaign::run_campaign(campaign::read_campaign(folder_.path() / "work.toml"),
                         folder_.path() / "whole");
  const std::vector<record::RawRow> merged = rows("out"), whole = rows("whole");
  ASSERT_EQ(merged.size(), whole.size());
  for (std::size_t i = 0; i < whole.size(); ++i) {
    EXPECT_EQ(merged[i].block, whole[i].block);
    EXPECT_EQ(label_of(merged[i]), label_of(whole[i]));
    EXPECT_EQ(merged[i].kind, whole[i].kind);
    EXPECT_EQ(merged[i].scene_hash, whole[i].scene_hash);
    EXPECT_EQ(merged[i].square, whole[i].square);
    EXPECT_EQ(merged[i].position, whole[i].position);
    if (whole[i].kind == record::RowKind::sample) continue;
    EXPECT_EQ(merged[i].pair_hash, whole[i].pair_hash);
    EXPECT_EQ(merged[i].outcome_hash, whole[i].outcome_hash);
  }
  const auto departures = [&](const std::string& of) {
    return record::read_rows<record::Departure>(folder_.path() / of / "departures.csv");
  };
  const std::vector<record::Departure> found = departures("out"), expected = departures("whole");
  ASSERT_THAT(found, SizeIs(expected.size()));
  ASSERT_GT(found.size(), 1u);
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].row, expected[i].row);
    EXPECT_EQ(found[i].what, expected[i].what);
    EXPECT_EQ(merged[static_cast<std::size_t>(found[i].row)].block, found[i].block);
    EXPECT_TRUE(std::filesystem::exists(found[i].reproduction)) << found[i].reproduction;
  }
  EXPECT_THAT(folder_.read("out/tables.md"), HasSubstr("sweep-one-axis"));
  EXPECT_THAT(result.merged.text, HasSubstr(out().string() + "/tables.md"));
  // A merge again keeps what others put there, and not what a kill left of the list of its own files.
  folder_.write("out/notes.txt", "of somebody");
  folder_.write("out/files.txt.7-0.tmp", "half");
  merge();
  EXPECT_EQ(folder_.read("out/notes.txt"), "of somebody");
  EXPECT_FALSE(std::filesystem::exists(out() / "files.txt.7-0.tmp"));
}

TEST_F(CampaignShards, BlocksThatDifferInThreadsAreInOneShard) {
  folder_.write("scene.toml", small_scene);
  const shards::ShardPlan plan =
      make(std::string(small_campaign) + "isa = [\"all\", \"baseline\"]\n", 4);
  for (const shards::PlannedShard& shard : plan.shards) EXPECT_EQ(shard.units.size(), 2);
  EXPECT_THAT(input_fault([&] {
                std::filesystem::remove_all(this->plan());
                make(std::string(small_campaign) + "isa = [\"all\", \"baseline\"]\n", 5);
              }),
              HasSubstr("has 4 parts that can be done apart"));
}

TEST_F(CampaignShards, TimesOfSeveralMachinesAreNotPooled) {
  plan_campaign(2);
  run(0);
  run(1);
  const shards::ShardPlan read = shards::read_plan(plan());
  // The blocks of a shard are the seeds of a count. The first shard's are then on two machines.
  move_to("faster", read.shards[0]);
  edit(part(0, 0, 1) / "machine.csv", "processor,", "processor,Better ");
  ASSERT_THAT(merge().missing, IsEmpty());
  // One host with two processors is two machines.
  EXPECT_TRUE(std::filesystem::exists(out() / "machines/faster-2/machine.csv"));
  EXPECT_THAT(input_fault([&] { stats::read_results(out()); }),
              HasSubstr("has rows of 3 machines, whose times are not pooled"));
  const auto of_machines = stats::read_machines(out());
  ASSERT_THAT(of_machines, SizeIs(3));
  std::size_t sets = 0;
  for (const auto& [name, results] : of_machines) {
    sets += results.sets.size();
    EXPECT_TRUE(std::filesystem::exists(out() / "machines" / name / "ratios.csv")) << name;
    EXPECT_FALSE(results.machine.empty());
  }
  EXPECT_EQ(sets, 8u);  // broad phases and boxes, in four blocks
  const auto across = record::read_rows<stats::AcrossRow>(out() / "across.csv");
  ASSERT_THAT(across, ::testing::Not(IsEmpty()));
  for (const stats::AcrossRow& row : across) {
    EXPECT_EQ(row.machines, 2);
    EXPECT_LE(row.least, row.greatest);
    // Rounds that other work disturbed are left out, and too few give no interval.
    EXPECT_EQ(std::isnan(row.low), std::isnan(row.high));
    EXPECT_FALSE(row.low > row.greatest);
    EXPECT_FALSE(row.high < row.least);
    EXPECT_EQ(row.key.seed, "");
  }
}

TEST_F(CampaignShards, ABlockThatAnotherMachineBeganIsMeasuredAnew) {
  plan_campaign(4);
  for (std::int64_t shard = 0; shard < 4; ++shard) run(shard);
  const std::filesystem::path block = part(2, 2, 3);
  edit(block / "machine.csv", "host," + shards::host_name(), "host,elsewhere");
  edit(block / "machine.csv", "finished,yes", "finished,no");
  edit(plan() / "shards/0/2/attempts.csv", "done", "interrupted");
  run(2);
  ASSERT_THAT(merge().missing, IsEmpty());
  const auto blocks = record::read_rows<stats::BlockRow>(out() / "blocks.csv");
  std::vector<std::string> machines;
  for (const stats::BlockRow& row : blocks) machines.push_back(row.machine);
  EXPECT_THAT(machines, SizeIs(4));
  EXPECT_THAT(machines, Each(shards::host_name()));
}

TEST_F(CampaignShards, ASceneThatChangedIsRefused) {
  plan_campaign(2);
  edit(folder_.path() / "scene.toml", "overlaps = 4", "overlaps = 3");
  EXPECT_THAT(input_fault([&] { shards::run_shard(plan(), 1, 1); }),
              HasSubstr("which the plan does not know; expected the scene that was planned"));
  EXPECT_EQ(status_of(shards::read_plan(plan()), 1).state, shards::ShardState::failed);
}

TEST_F(CampaignShards, TradesStayFolders) {
  folder_.write("scene.toml", small_scene);
  make(
      "[trade]\nscene = \"scene.toml\"\nseed = [1, 2]\nseconds = 1\nframes = 2\n"
      "[[trade.grid]]\nnarrow = [\"gjk\", \"sat\"]\n",
      2);
  run(1);
  run(0);
  ASSERT_THAT(merge().missing, IsEmpty());
  for (const char* name : {"work-0", "work-1"}) {
    EXPECT_THAT(folder_.read("out/" + std::string(name) + "/points.csv"), HasSubstr("gjk"));
    EXPECT_THAT(folder_.read("out/" + std::string(name) + "/machine.csv"), HasSubstr("plan,"));
  }
}

}  // namespace
}  // namespace touchstone
