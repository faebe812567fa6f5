// Campaigns on scenes with bodies that are not convex.
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>

#include "harness/campaign/campaign.h"
#include "harness/campaign/runner.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone::campaign {
namespace {

constexpr const char* links = R"(
generator = "uniform"
count = 24
frames = 2
overlaps = 5
shapes = [{type = "torus", around = 10, across = 5, as = "surface", scale = 0.5}, "box"]
)";

constexpr const char* settings = R"(
scenes = ["links.toml"]
broad = "packed-rtree"
narrow = "gjk"
concave = ["ours", "peers"]
mid_phases = ["wide-bvh", "binary-bvh"]
tasks = ["intersect", "distance", "contacts"]
)";

TEST(ConcaveCampaign, ChecksEveryPhaseAgainstTheOracle) {
  const TemporaryFolder folder;
  folder.write("links.toml", links);
  const Campaign campaign = read_campaign(folder.write("campaign.toml", settings));
  const record::Findings findings = check_campaign(campaign);
  std::set<std::string> names;
  std::map<std::string, std::set<std::int64_t>> part_pairs;
  std::int64_t hits = 0, misses = 0;
  for (const record::RawRow& row : findings.rows()) {
    if (!row.is_narrow() || row.status == record::RowStatus::unsupported) continue;
    const bool convex = row.pair_kind == "box-box";
    EXPECT_EQ(convex, row.narrow == "gjk") << row.narrow << row.pair_kind;
    names.insert(row.narrow);
    if (row.origin != record::RowOrigin::ours || convex) continue;
    const bool exact = row.narrow != "moller" && !row.narrow.starts_with("moller ") &&
                       !row.narrow.starts_with("guigue-devillers");
    if (!exact) continue;
    EXPECT_EQ(row.disagreements, 0) << row.narrow << " " << row.pair_kind;
    EXPECT_EQ(row.failures, 0) << row.narrow << " " << row.pair_kind;
    EXPECT_EQ(row.compared, row.pair_count);
    hits += row.contact_count;
    misses += row.pair_count - row.contact_count;
    EXPECT_EQ(row.part_pairs >= 0, row.task == record::QueryTask::contacts);
    if (row.part_pairs >= 0) {
      part_pairs[row.pair_kind + std::to_string(row.frame)].insert(row.part_pairs);
    }
  }
  EXPECT_GT(hits, 0);
  EXPECT_GT(misses, 0);
  for (const char* name : {"gjk", "fused", "part-pairs wide-bvh", "part-pairs binary-bvh"}) {
    EXPECT_TRUE(names.contains(name)) << name;
  }
  EXPECT_FALSE(part_pairs.empty());
  for (const auto& [where, counts] : part_pairs) EXPECT_EQ(counts.size(), 1u) << where;
}

TEST(ConcaveCampaign, RulesNameConcavePhases) {
  const TemporaryFolder folder;
  folder.write("links.toml", links);
  const Campaign campaign = read_campaign(folder.write(
      "campaign.toml", std::string(settings) + "exclude = [{narrow = \"part-pairs\"}]\n"));
  const CampaignGroup& group = campaign.groups.at(0);
  for (const measure::NarrowChoice& choice : group.concave) {
    CampaignCell cell;
    cell.scene = "links";
    cell.narrow = choice.name();
    EXPECT_EQ(group.admits(cell), choice.concave->info.name != "part-pairs") << choice.name();
  }
}

}  // namespace
}  // namespace touchstone::campaign
