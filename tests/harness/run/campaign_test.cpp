#include "harness/run/campaign.h"

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
  Campaign read(const std::string& text) {
    std::ofstream(folder_.path() / "c.toml") << text;
    return read_campaign(folder_.path() / "c.toml");
  }
  std::string fault(const std::string& text) {
    return input_fault([&] { read(text); });
  }
  TemporaryFolder folder_;
};

TEST_F(CampaignFile, HasDefaultsForEverythingButTheScenes) {
  const Campaign campaign = read("scenes = 'a.toml'");
  EXPECT_EQ(campaign.name, "c");
  ASSERT_EQ(campaign.groups.size(), 1u);
  const CampaignGroup& group = campaign.groups[0];
  EXPECT_EQ(group.scenes, std::vector{folder_.path() / "a.toml"});
  EXPECT_EQ(group.threads, std::vector{2});
  EXPECT_EQ(group.tasks, std::vector{Task::intersect});
  EXPECT_GE(group.broad.size(), 5u);
  for (const NarrowChoice& choice : group.narrow)
    EXPECT_TRUE(offers(*choice.entry, choice.settings.scalar));
}

TEST_F(CampaignFile, GroupsInheritAndOverride) {
  const Campaign campaign = read(R"(
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
broad = ["naive", "sweep-and-prune"]
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
  const CampaignGroup& second = campaign.groups[1];
  EXPECT_EQ(second.threads, std::vector{3});
  ASSERT_EQ(second.broad.size(), 2u);
  EXPECT_EQ(second.broad[1]->info.name, "sweep-and-prune");
  ASSERT_EQ(second.narrow.size(), 2u);
  EXPECT_EQ(second.narrow[1].settings.tolerance, 1e-6);
  EXPECT_EQ(second.narrow[1].settings.max_iterations, 9);
  EXPECT_EQ(second.tasks, (std::vector{Task::distance, Task::penetration}));
  EXPECT_EQ(second.boxes, (std::vector{BoxKind::loose, BoxKind::tight}));
  EXPECT_EQ(second.pairing, Pairing::product);
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
              AllOf(HasSubstr("c.toml:3:"), HasSubstr("'sap'"), HasSubstr("sweep-and-prune")));
  EXPECT_THAT(fault("scenes = 'a.toml'\nthreads = 0"), HasSubstr("c.toml:2:"));
  EXPECT_THAT(fault("scenes = 'a.toml'\nthreads = 'two'"), HasSubstr("c.toml:2:"));
  EXPECT_THAT(fault("scenes = 'a.toml'\ntask = 'distance'"),
              AllOf(HasSubstr("c.toml:2:"), HasSubstr("unknown key task"), HasSubstr("tasks")));
  EXPECT_THAT(fault("scenes = 'a.toml'\n[[group]]\ntolerances = [2]"), HasSubstr("c.toml:3:"));
  EXPECT_THAT(fault("scenes = 'a.toml'\n[[group]]\nscnes = 'b'"), HasSubstr("c.toml:3:"));
  EXPECT_THAT(fault("scenes = []"), HasSubstr("c.toml:1:"));
  EXPECT_THAT(fault("scenes = 'a.toml"), HasSubstr("c.toml:1:"));
}

}  // namespace
