// A campaign as work in shards: its units are blocks.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <set>

#include "harness/base/error.h"
#include "harness/campaign/blocks.h"
#include "harness/campaign/plan.h"
#include "harness/campaign/runner.h"
#include "harness/record/raw_row.h"
#include "harness/shards/merged_run.h"
#include "harness/shards/shard_run.h"
#include "harness/shards/work.h"

namespace touchstone::shards {
namespace {

constexpr std::string_view scene_prefix = "scene ";

class CampaignWork final : public Work {
 public:
  CampaignWork(const std::filesystem::path& file, const std::filesystem::path& home)
      : campaign_(campaign::read_campaign(file, home)) {}

  std::string_view kind() const override { return "run"; }
  const std::string& name() const override { return campaign_.name; }
  bool is_timed() const override { return true; }
  std::int64_t units() const override { return blocks().size(); }
  bool belongs_to_previous(std::int64_t unit) const override {
    return blocks().belongs_to_previous(unit);
  }
  record::Facts identity() const override {
    return campaign::campaign_identity(campaign_, blocks().scene_hashes());
  }

  std::vector<double> estimate(const std::filesystem::path& earlier) const override {
    if (!earlier.empty()) return estimate_from(earlier);
    std::vector<double> seconds;
    for (const campaign::PlannedBlock& block : campaign::plan_campaign(campaign_)) {
      constexpr double least = 0.1;  // of a process that starts
      seconds.push_back(least + block.check_seconds + (block.sets.empty() ? 0 : block.seconds));
    }
    return seconds;
  }

  // Only the scenes of these units are loaded.
  void expect_planned(const record::Facts& planned, base::UnitRange units) const override {
    record::Facts now = campaign::campaign_identity(campaign_, {});
    const campaign::CampaignBlocks here(campaign_, units);
    for (const auto& [scene, hashes] : here.scene_hashes()) {
      const std::string name = std::string(scene_prefix) + scene;
      const std::set<std::string> known = words(planned, name);
      for (const std::string& hash : words({{name, hashes}}, name)) {
        if (known.contains(hash)) continue;
        throw base::InputError(fmt::format(
            "the {} has the hash {}, which the plan does not know; expected the scene that was "
            "planned",
            name, hash));
      }
    }
    expect_facts(planned, now);
  }

  PartEnd run(const record::Part& part, const std::filesystem::path& folder,
              record::FolderStart start, int /*workers*/) override {
    const campaign::RunResult result = campaign::run_campaign(campaign_, folder, start, part);
    return result.interrupted ? PartEnd::interrupted : PartEnd::done;
  }

  std::vector<std::string> row_files() const override { return {"raw.csv"}; }
  Merged merge(std::span<const DonePart> parts, const MergeFolder& folder) override {
    return merge_runs(parts, campaign_.published, folder);
  }

 private:
  // A block takes about twice the time in its rows: what it is warmed up with is not timed.
  std::vector<double> estimate_from(const std::filesystem::path& earlier) const {
    constexpr double untimed = 2;
    const std::string hash = record::value_of(facts_of(earlier), "campaign_hash");
    if (hash != record::value_of(campaign::campaign_identity(campaign_, {}), "campaign_hash")) {
      throw base::InputError(earlier.string(), 0,
                             "is not of this campaign; expected results of an earlier run of it");
    }
    std::vector<double> seconds(static_cast<std::size_t>(units()), 0);
    record::reader_of<record::RawRow>(earlier / "raw.csv")
        .read([&](const files::CsvReader::Row& fields) {
          const auto row = record::read_row<record::RawRow>(fields);
          if (row.block < 0 || row.block >= units() || !(row.seconds > 0)) return;
          seconds[static_cast<std::size_t>(row.block)] += untimed * row.seconds;
        });
    for (const double block : seconds) {
      if (block > 0) continue;
      throw base::InputError((earlier / "raw.csv").string(), 0,
                             "lacks a block of the campaign; expected a whole run");
    }
    return seconds;
  }
  // Loads all scenes, which a shard does not need.
  const campaign::CampaignBlocks& blocks() const {
    if (!blocks_) blocks_ = std::make_unique<campaign::CampaignBlocks>(campaign_);
    return *blocks_;
  }
  // Returns the words of a fact: the hashes of the scenes with one name and count.
  static std::set<std::string> words(const record::Facts& facts, const std::string& name) {
    std::set<std::string> found;
    for (const auto& [key, value] : facts) {
      if (key != name) continue;
      for (std::size_t at = 0; at < value.size();) {
        const std::size_t end = std::min(value.find(' ', at), value.size());
        found.insert(value.substr(at, end - at));
        at = end + 1;
      }
    }
    return found;
  }

  campaign::Campaign campaign_;
  mutable std::unique_ptr<campaign::CampaignBlocks> blocks_;
};

}  // namespace

std::unique_ptr<Work> campaign_work(const std::filesystem::path& file,
                                    const std::filesystem::path& home) {
  return std::make_unique<CampaignWork>(file, home);
}

}  // namespace touchstone::shards
