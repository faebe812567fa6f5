// A campaign as work in shards: its units are blocks.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <system_error>

#include "harness/base/error.h"
#include "harness/base/input_file.h"
#include "harness/campaign/blocks.h"
#include "harness/campaign/plan.h"
#include "harness/campaign/runner.h"
#include "harness/files/text_file.h"
#include "harness/record/findings.h"
#include "harness/record/raw_row.h"
#include "harness/shards/shard_folder.h"
#include "harness/shards/work.h"
#include "harness/stats/machines.h"
#include "harness/stats/published.h"
#include "harness/stats/summary.h"

namespace touchstone::shards {
namespace {

constexpr std::int64_t most_rows_of_tables = 1'000'000;

enum : std::size_t { raw_file, departures_file };
constexpr const char* reproductions = "reproductions";

class RunMerge {
 public:
  explicit RunMerge(const MergeFolder& folder)
      : into_(folder.path),
        place_(folder.place),
        folder_({.folder = folder.path,
                 .files = campaign::run_files(),
                 .identity = folder.facts,
                 .start = record::FolderStart::overwrite,
                 .work = "merge"}) {}

  void add(const DonePart& part) {
    const std::int64_t rows = folder_.append(raw_file, part.folder);
    for (record::Departure& one :
         record::read_rows<record::Departure>(part.folder / "departures.csv")) {
      if (one.row >= 0) one.row += rows_;
      if (!one.reproduction.empty()) one.reproduction = take_reproduction(part, one.reproduction);
      folder_.write(departures_file, one);
      departures_.push_back(std::move(one));
    }
    blocks_.push_back({part.units.first, part.shard, part.machine, rows});
    rows_ += rows;
  }

  Merged finish(const stats::Published& published) {
    folder_.commit();
    folder_.finish();
    record::write_rows(into_ / "blocks.csv", blocks_);
    Merged merged;
    merged.ours_wrong = record::ours_are_wrong(departures_);
    if (rows_ > most_rows_of_tables) {
      merged.text = fmt::format(
          "{} rows: their tables have to fit into memory, and are not made here; `touchstone show "
          "DIR --tables` makes them\n",
          rows_);
    } else {
      merged.text = make_tables(published);
    }
    return merged;
  }

 private:
  // Copies the file into the merged folder and returns its name there.
  std::string take_reproduction(const DonePart& part, const std::string& file) {
    const std::size_t at = file.rfind(reproductions);
    if (at == std::string::npos) return file;
    const std::filesystem::path name = std::filesystem::path(file.substr(at)).lexically_normal();
    if (!files::is_regular_inside(part.folder / name, part.folder / reproductions)) {
      throw base::InputError(
          (part.folder / "departures.csv").string(), 0,
          fmt::format("names {}, which is no file in {} of the part; expected one",
                      base::shortened(name.string()), reproductions));
    }
    std::error_code error;
    std::filesystem::create_directories((into_ / name).parent_path(), error);
    std::filesystem::copy_file(part.folder / name, into_ / name,
                               std::filesystem::copy_options::skip_existing, error);
    if (error) {
      throw base::InputError((part.folder / name).string(), 0,
                             "cannot be copied: " + error.message());
    }
    return (place_ / name).string();
  }

  std::string make_tables(const stats::Published& published) const {
    const std::map<std::string, stats::Results> of_machines = stats::read_machines(into_);
    if (of_machines.size() == 1) {
      const stats::Results& results = of_machines.begin()->second;
      return stats::write_report(results, departures_, &published, {}, into_).summary;
    }
    return stats::write_machine_tables(of_machines, {}, 1, into_);
  }

  std::filesystem::path into_, place_;
  record::ResultFolder folder_;
  std::int64_t rows_ = 0;
  std::vector<stats::BlockRow> blocks_;
  std::vector<record::Departure> departures_;
};

// Writes raw.csv, departures.csv, reproductions/, blocks.csv and machine.csv into the folder, and the
// tables: of each machine in machines/NAME if there are several, with across.csv and
// across.md, the range of their ratios. Rows are streamed; the tables of more than
// `most_rows_of_tables` rows, which would have to fit into memory, are left to `show --tables`.
Merged merge_runs(std::span<const DonePart> parts, const stats::Published& published,
                  const MergeFolder& folder) {
  RunMerge merge(folder);
  for (const DonePart& part : parts) merge.add(part);
  return merge.finish(published);
}

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
