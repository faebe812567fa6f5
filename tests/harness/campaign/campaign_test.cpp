// Tests of campaign files.
#include "harness/campaign/campaign.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "tests/harness/input_fault.h"
#include "tests/harness/temporary_folder.h"

namespace {

using namespace touchstone;

class CampaignFile : public testing::Test {
 protected:
  campaign::Campaign read(const std::string& text) {
    std::ofstream(folder_.path() / "c.toml") << text;
    return campaign::read_campaign(folder_.path() / "c.toml");
  }
  std::string fault(const std::string& text) {
    return input_fault([&] { read(text); });
  }
  TemporaryFolder folder_;
};

TEST_F(CampaignFile, HasDefaultsForEverythingButTheScenes) {
  const campaign::Campaign campaign = read("scenes = 'a.toml'");
  EXPECT_EQ(campaign.name, "c");
  ASSERT_EQ(campaign.groups.size(), 1u);
  const campaign::CampaignGroup& group = campaign.groups[0];
  EXPECT_EQ(group.scenes, std::vector{folder_.path() / "a.toml"});
  EXPECT_EQ(group.threads, std::vector{2});
  EXPECT_EQ(group.tasks, std::vector{record::QueryTask::intersect});
  EXPECT_GE(group.broad.size(), 5u);
  for (const measure::NarrowChoice& choice : group.narrow)
    EXPECT_TRUE(offers(*choice.entry, choice.settings.scalar));
}

TEST_F(CampaignFile, WarmStartsStandBesideColdOnes) {
  const auto labels = [&](const std::string& warm) {
    const campaign::Campaign campaign =
        read("scenes = 'a.toml'\nnarrow = ['gjk', 'mpr']\nscalars = 'double'\n" + warm);
    std::vector<std::string> all;
    for (const measure::NarrowChoice& choice : campaign.groups[0].narrow)
      all.push_back(choice.label());
    return all;
  };
  using testing::ElementsAre;
  EXPECT_THAT(labels(""), ElementsAre("gjk double", "mpr double"));
  EXPECT_THAT(labels("warm = false"), ElementsAre("gjk double", "mpr double"));
  EXPECT_THAT(labels("warm = true"), ElementsAre("gjk double warm", "mpr double"));
  EXPECT_THAT(labels("warm = [true, false]"),
              ElementsAre("gjk double", "gjk double warm", "mpr double"));
  EXPECT_THAT(fault("scenes = 'a.toml'\nwarm = 'yes'"), testing::HasSubstr("c.toml:2: warm"));
  EXPECT_NE(campaign::description(read("scenes = 'a.toml'\nwarm = true")),
            campaign::description(read("scenes = 'a.toml'")));
  EXPECT_EQ(campaign::description(read("scenes = 'a.toml'\nwarm = false")),
            campaign::description(read("scenes = 'a.toml'")));

  const campaign::Campaign ruled =
      read("scenes = 'a.toml'\nexclude = [{narrow = 'gjk', warm = true, task = 'distance'}]");
  campaign::CampaignCell cell;
  cell.narrow = "gjk";
  cell.task = record::QueryTask::distance;
  cell.warm = true;
  EXPECT_FALSE(ruled.groups[0].admits(cell));
  cell.warm = false;
  EXPECT_TRUE(ruled.groups[0].admits(cell));
}

TEST_F(CampaignFile, ExecutorsAreChosen) {
  const auto executors = [&](const std::string& line) {
    return read("scenes = 'a.toml'\n" + line).groups[0].executors;
  };
  using testing::ElementsAre;
  EXPECT_THAT(executors(""), ElementsAre(usual_executor));
  EXPECT_THAT(executors("executor = 'crew'"), ElementsAre(ExecutorKind::crew));
  EXPECT_THAT(executors("executor = 'onetbb'"), ElementsAre(ExecutorKind::onetbb));
  EXPECT_THAT(executors("executor = ['onetbb', 'crew']"),
              ElementsAre(ExecutorKind::onetbb, ExecutorKind::crew));
  EXPECT_THAT(
      fault("scenes = 'a.toml'\nexecutor = 'tbb'"),
      testing::HasSubstr("c.toml:2: executor: found \"tbb\"; expected one of crew, onetbb"));
  EXPECT_NE(campaign::description(read("scenes = 'a.toml'\nexecutor = 'onetbb'")),
            campaign::description(read("scenes = 'a.toml'")));
  EXPECT_EQ(campaign::description(read("scenes = 'a.toml'\nexecutor = 'crew'")),
            campaign::description(read("scenes = 'a.toml'")));
}

TEST_F(CampaignFile, OnePairACallStandsBesideBatches) {
  const auto labels = [&](const std::string& batch) {
    const campaign::Campaign campaign =
        read("scenes = 'a.toml'\nnarrow = ['gjk', 'mpr']\nscalars = 'double'\n" + batch);
    std::vector<std::string> all;
    for (const measure::NarrowChoice& choice : campaign.groups[0].narrow)
      all.push_back(choice.label());
    return all;
  };
  using testing::ElementsAre;
  EXPECT_THAT(labels("batch = 256"), ElementsAre("gjk double", "mpr double"));
  EXPECT_THAT(labels("batch = 1"), ElementsAre("gjk double by 1", "mpr double by 1"));
  EXPECT_THAT(labels("batch = [1, 256]"),
              ElementsAre("gjk double by 1", "gjk double", "mpr double by 1", "mpr double"));
  EXPECT_THAT(labels("batch = 1\nwarm = true"),
              ElementsAre("gjk double warm by 1", "mpr double by 1"));
  for (const std::string wrong : {"0", "257", "1.5", "'all'", "[1, 0]"}) {
    EXPECT_THAT(fault("scenes = 'a.toml'\nbatch = " + wrong), testing::HasSubstr("c.toml:2: batch"))
        << wrong;
  }
  EXPECT_NE(campaign::description(read("scenes = 'a.toml'\nbatch = 1")),
            campaign::description(read("scenes = 'a.toml'")));

  const campaign::Campaign ruled =
      read("scenes = 'a.toml'\nbatch = [1, 256]\ninclude = [{batch = 1}, {narrow = 'gjk'}]");
  campaign::CampaignCell cell;
  cell.narrow = "mpr";
  cell.batch = 256;
  EXPECT_FALSE(ruled.groups[0].admits(cell));
  cell.batch = 1;
  EXPECT_TRUE(ruled.groups[0].admits(cell));
  cell = {};
  cell.narrow = "gjk";
  cell.batch = 256;
  EXPECT_TRUE(ruled.groups[0].admits(cell));
}

TEST_F(CampaignFile, RulesNameAPlacedSceneWithOrWithoutItsGap) {
  const auto admits = [&](const std::string& named, const std::string& scene) {
    const campaign::Campaign ruled =
        read("scenes = 'a.toml'\nexclude = [{scene = '" + named + "', narrow = 'gjk'}]");
    campaign::CampaignCell cell;
    cell.scene = scene;
    cell.narrow = "gjk";
    return ruled.groups[0].admits(cell);
  };
  EXPECT_FALSE(admits("hulls", "hulls"));
  EXPECT_FALSE(admits("hulls", "hulls gap 0.1"));
  EXPECT_FALSE(admits("hulls", "hulls depth 0.1"));
  EXPECT_FALSE(admits("hulls gap 0.1", "hulls gap 0.1"));
  EXPECT_TRUE(admits("hulls gap 0.1", "hulls gap 0.001"));
  EXPECT_TRUE(admits("hulls", "hulls_8 gap 0.1"));
}

TEST_F(CampaignFile, KeysOfLargeCells) {
  const campaign::Campaign plain = read("scenes = 'a.toml'");
  EXPECT_EQ(plain.groups[0].isa, std::vector<std::optional<Isa>>{std::nullopt});
  EXPECT_FALSE(plain.groups[0].limit);
  EXPECT_FALSE(plain.groups[0].rounds);
  EXPECT_EQ(plain.groups[0].processes, 3);
  const campaign::Campaign campaign = read(
      "scenes = 'a.toml'\nisa = ['all', 'avx2', 'baseline']\nlimit = true\nrounds = 1\n"
      "processes = 2");
  const campaign::CampaignGroup& group = campaign.groups[0];
  EXPECT_EQ(group.isa, (std::vector<std::optional<Isa>>{std::nullopt, Isa::avx2, Isa::baseline}));
  EXPECT_TRUE(group.limit);
  EXPECT_EQ(group.rounds, 1);
  EXPECT_EQ(group.processes, 2);
  EXPECT_NE(campaign::description(plain), campaign::description(campaign));
  EXPECT_THAT(fault("scenes = 'a.toml'\nisa = 'sse'"), testing::HasSubstr("c.toml:2: isa"));
  EXPECT_THAT(fault("scenes = 'a.toml'\nrounds = 5"), testing::HasSubstr("c.toml:2: rounds"));
  EXPECT_THAT(fault("scenes = 'a.toml'\nprocesses = 0"), testing::HasSubstr("processes"));
}

TEST_F(CampaignFile, GapsAreNumbers) {
  const campaign::Campaign plain = read("scenes = 'a.toml'");
  EXPECT_EQ(plain.groups[0].gaps, std::vector<std::optional<double>>{std::nullopt});
  const campaign::Campaign campaign = read("scenes = 'a.toml'\ngaps = [10, 1e-3, -0.2]");
  EXPECT_EQ(campaign.groups[0].gaps, (std::vector<std::optional<double>>{10, 1e-3, -0.2}));
  EXPECT_NE(campaign::description(plain), campaign::description(campaign));
  EXPECT_NE(campaign::description(campaign),
            campaign::description(read("scenes = 'a.toml'\ngaps = [10, 1e-3, 0.2]")));
  EXPECT_THAT(fault("scenes = 'a.toml'\ngaps = ['x']"), testing::HasSubstr("c.toml:2: gaps"));
  EXPECT_THAT(fault("scenes = 'a.toml'\ngaps = nan"), testing::HasSubstr("c.toml:2: gaps"));
  EXPECT_THAT(fault("scenes = 'a.toml'\ngaps = 1e9"), testing::HasSubstr("c.toml:2: gaps"));
}

TEST_F(CampaignFile, GroupsInheritAndOverride) {
  const campaign::Campaign campaign = read(R"(
name = "n"
seed = 7
threads = [1, 2]
narrow = "none"
[[group]]
scenes = ["a.toml", "b.toml"]
counts = [10, 20]
[[group]]
scenes = "a.toml"
threads = 3
broad = ["naive", "sweep-one-axis"]
narrow = ["gjk"]
scalars = "double"
tolerances = [1e-3, 1e-6]
max_iterations = 9
tasks = ["distance", "penetration"]
boxes = ["loose", "tight"]
pairing = "product"
rebuild = true
frames = 4
seeds = [3]
time_limit = 0.5
)");
  EXPECT_EQ(campaign.name, "n");
  EXPECT_EQ(campaign.seed, 7u);
  ASSERT_EQ(campaign.groups.size(), 2u);
  EXPECT_EQ(campaign.groups[0].threads, (std::vector{1, 2}));
  EXPECT_EQ(campaign.groups[0].counts, (std::vector<std::int64_t>{10, 20}));
  EXPECT_TRUE(campaign.groups[0].narrow.empty());
  const campaign::CampaignGroup& second = campaign.groups[1];
  EXPECT_EQ(second.threads, std::vector{3});
  ASSERT_EQ(second.broad.size(), 2u);
  EXPECT_EQ(second.broad[1]->info.name, "sweep-one-axis");
  ASSERT_EQ(second.narrow.size(), 2u);
  EXPECT_EQ(second.narrow[1].settings.tolerance, 1e-6);
  EXPECT_EQ(second.narrow[1].settings.max_iterations, 9);
  EXPECT_EQ(second.tasks,
            (std::vector{record::QueryTask::distance, record::QueryTask::penetration}));
  EXPECT_EQ(second.boxes, (std::vector{scene::BoxKind::loose, scene::BoxKind::tight}));
  EXPECT_EQ(second.pairing, campaign::Pairing::product);
  EXPECT_TRUE(second.rebuild);
  EXPECT_EQ(second.frames, 4);
  EXPECT_EQ(second.seeds, std::vector<std::int64_t>{3});
  EXPECT_EQ(second.time_limit, 0.5);
}

TEST_F(CampaignFile, TellsFaultsWithTheirLine) {
  using testing::AllOf;
  using testing::HasSubstr;
  EXPECT_THAT(fault("name = 'x'"), HasSubstr("scenes"));
  EXPECT_THAT(fault("scenes = 'a.toml'\n\nbroad = 'sap'"),
              AllOf(HasSubstr("c.toml:3:"), HasSubstr("'sap'"), HasSubstr("sweep-one-axis")));
  EXPECT_THAT(fault("scenes = 'a.toml'\nthreads = 0"), HasSubstr("c.toml:2:"));
  EXPECT_THAT(fault("scenes = 'a.toml'\nthreads = 'two'"), HasSubstr("c.toml:2:"));
  EXPECT_THAT(fault("scenes = 'a.toml'\ntask = 'distance'"),
              AllOf(HasSubstr("c.toml:2:"), HasSubstr("unknown key task"), HasSubstr("tasks")));
  EXPECT_THAT(fault("scenes = 'a.toml'\n[[group]]\ntolerances = [2]"), HasSubstr("c.toml:3:"));
  EXPECT_THAT(fault("scenes = 'a.toml'\n[[group]]\nscnes = 'b'"), HasSubstr("c.toml:3:"));
  EXPECT_THAT(fault("scenes = []"), HasSubstr("c.toml:1:"));
  EXPECT_THAT(fault("scenes = 'a.toml"), HasSubstr("c.toml:1:"));
}

TEST_F(CampaignFile, EveryKeyRefusesWhatIsNoneOfItsValues) {
  using testing::AllOf;
  using testing::HasSubstr;
  const struct {
    const char* key;
    std::vector<const char*> wrong;
  } cases[] = {
      {"name", {"7", "['a']"}},
      {"seed", {"-1", "1.5", "'one'", "99999999999999999999"}},
      {"scenes", {"7", "['a.toml', 3]", "[]", "{a = 1}"}},
      {"counts", {"0", "-3", "1.5", "'many'", "[]", "[10, 'x']", "100_000_001"}},
      {"seeds", {"-1", "'x'", "[1, 2.5]", "[]"}},
      {"frames", {"0", "-1", "'all'", "[3]", "1_000_001"}},
      {"boxes", {"'round'", "1", "['tight', 'round']", "[]"}},
      {"threads", {"0", "-2", "1025", "'two'", "1.0", "[]"}},
      {"executor", {"'tbb'", "2", "['crew', 1]", "[]"}},
      {"rebuild", {"1", "'yes'"}},
      {"broad", {"'nobody'", "3", "['naive', 4]", "'gjk'", "[]"}},
      {"narrow", {"'nobody'", "3", "['gjk', true]", "'naive'", "[]"}},
      {"scalars", {"'half'", "64", "[]"}},
      {"tolerances", {"0", "-1e-3", "1", "nan", "inf", "'small'", "[1e-3, 0]", "[]"}},
      {"max_iterations", {"0", "-1", "2.5", "'ten'", "1_000_001"}},
      {"tasks", {"'touch'", "1", "['distance', 'touch']", "[]"}},
      {"pairing", {"'both'", "1", "true"}},
      {"time_limit", {"0", "-1", "nan", "inf", "'long'", "[1]"}},
      {"memory_limit", {"0", "-1", "1.5", "'much'", "16_777_217"}},
      {"width", {"0", "-0.1", "11", "nan", "'narrow'"}},
      {"seconds", {"0", "-1", "nan", "inf", "'ten'"}},
      {"squares", {"0", "5", "-6", "6.0", "'six'", "10_001"}},
      {"include", {"7", "'naive'", "[]", "[7]", "{broad = 'nobody'}", "{brod = 'naive'}"}},
      {"exclude",
       {"{broad = 7}", "{narrow = 'naive'}", "{broad = 'naive', narrow = 'gjk'}", "{scene = 1}",
        "{scalar = 'half'}", "{task = 'touch'}", "{pair_kind = 3}", "{boxes = 'round'}",
        "{threads = 0}", "{threads = 'x'}", "{counts_above = -1}", "{counts_below = 1.5}",
        "[{broad = 'naive'}, {thread = 1}]"}},
      {"group", {"7", "[]", "[7]"}},
  };
  for (const auto& [key, wrong] : cases) {
    for (const std::string value : wrong) {
      const std::string line = std::string(key) + " = " + value;
      const bool own_scenes = std::string(key) == "scenes";
      const std::string first = own_scenes ? "name = 'n'\n" : "scenes = 'a.toml'\n";
      EXPECT_THAT(fault(first + line), HasSubstr("c.toml:2:")) << line;
      const std::string top_only = std::string(key);
      if (top_only == "name" || top_only == "seed" || top_only == "group") continue;
      EXPECT_THAT(fault(first + "\n[[group]]\n" + line), HasSubstr("c.toml:4:")) << line;
    }
  }
}

TEST_F(CampaignFile, AKeyThatIsNoneIsRefusedWhereverItStands) {
  using testing::HasSubstr;
  EXPECT_THAT(fault("scenes = 'a.toml'\nsecond = 1"), HasSubstr("c.toml:2: unknown key second"));
  EXPECT_THAT(fault("scenes = 'a.toml'\n[[group]]\nseed = 3"), HasSubstr("c.toml:3:"));
  EXPECT_THAT(fault("scenes = 'a.toml'\n[[groups]]\nseconds = 3"), HasSubstr("c.toml:2:"));
}

TEST_F(CampaignFile, ADefaultThatIsWrongIsToldThoughEachGroupHasItsOwn) {
  EXPECT_THAT(fault("scenes = 'a.toml'\nseconds = -1\n[[group]]\nseconds = 2"),
              testing::HasSubstr("c.toml:2:"));
}

TEST_F(CampaignFile, TheMeasuringIsAsTheFileSays) {
  const campaign::CampaignGroup group =
      read(
          "scenes = 'a.toml'\nwidth = 0.5\nseconds = 3\nsquares = 6\nmemory_limit = 8\n"
          "time_limit = 0.25\ninclude = {task = 'distance'}\n"
          "exclude = [{broad = 'naive', counts_above = 9}, {threads = 2}]")
          .groups.at(0);
  EXPECT_EQ(group.width, 0.5);
  EXPECT_EQ(group.seconds, 3);
  EXPECT_EQ(group.squares, 6);
  EXPECT_EQ(group.memory_limit, std::size_t{8} << 20);
  EXPECT_EQ(group.time_limit, 0.25);
  ASSERT_EQ(group.include.size(), 1u);
  EXPECT_EQ(group.include[0].task, record::QueryTask::distance);
  ASSERT_EQ(group.exclude.size(), 2u);
  EXPECT_EQ(group.exclude[0].counts_above, 9);
  EXPECT_EQ(group.exclude[1].threads, 2);
}

}  // namespace
