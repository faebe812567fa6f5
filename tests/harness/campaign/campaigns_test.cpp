// Tests that the project's campaigns can be read, and that their scenes exist.
#include <gtest/gtest.h>

#include <filesystem>

#include "algorithms/registry.h"
#include "harness/campaign/campaign.h"
#include "harness/files/toml_table.h"
#include "tests/project_folder.h"

namespace touchstone {
namespace {

TEST(Campaigns, AllAreReadAndTheirScenesAreThere) {
  // The campaigns name peers, which must be built.
  for (const BroadPhaseEntry& entry : registry::entries<BroadPhaseEntry>()) {
    if (!is_built(entry.info)) GTEST_SKIP() << entry.info.name << ": " << entry.info.reason;
  }
  for (const NarrowPhaseEntry& entry : registry::entries<NarrowPhaseEntry>()) {
    if (!is_built(entry.info)) GTEST_SKIP() << entry.info.name << ": " << entry.info.reason;
  }
  int count = 0;
  const std::filesystem::path folder =
      std::filesystem::path(touchstone::project_folder) / "datasets/campaigns";
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".toml") continue;
    if (files::has_key(entry.path(), "group.kind")) continue;  // others read these
    const campaign::Campaign campaign = campaign::read_campaign(entry.path());
    ++count;
    for (const campaign::CampaignGroup& group : campaign.groups) {
      for (const auto& scene : group.scenes) {
        EXPECT_TRUE(std::filesystem::exists(scene)) << entry.path() << " names " << scene;
      }
    }
  }
  EXPECT_GE(count, 8);
}

}  // namespace
}  // namespace touchstone
