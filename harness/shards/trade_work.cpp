// Trades as work in shards: a unit is the trade of one scene, count and seed.
#include <fmt/format.h>

#include <system_error>
#include <vector>

#include "harness/base/error.h"
#include "harness/base/hash.h"
#include "harness/proxies/representation.h"
#include "harness/record/machine.h"
#include "harness/shards/work.h"
#include "harness/trade/trade_job.h"

namespace touchstone::shards {
namespace {

class TradeWork final : public Work {
 public:
  TradeWork(const std::filesystem::path& file, const std::filesystem::path& home)
      : name_(file.stem().string()), requests_(trade::read_trades(file, home)) {
    if (requests_.size() == 1) name_ = requests_.front().name;
  }

  std::string_view kind() const override { return "trade"; }
  const std::string& name() const override { return name_; }
  bool is_timed() const override { return true; }
  std::int64_t units() const override { return std::ssize(requests_); }
  bool belongs_to_previous(std::int64_t /*unit*/) const override { return false; }

  record::Facts identity() const override { return facts_of({0, units()}); }
  std::vector<double> estimate(const std::filesystem::path& earlier) const override {
    expect_no_earlier(earlier);
    std::vector<double> seconds;
    for (const trade::TradeRequest& request : requests_) seconds.push_back(request.seconds);
    return seconds;
  }
  void expect_planned(const record::Facts& planned, base::UnitRange units) const override {
    expect_facts(planned, facts_of(units));
  }

  // A trade that was stopped is measured anew, since its times belong together.
  PartEnd run(const record::Part& part, const std::filesystem::path& folder,
              record::FolderStart /*start*/, int /*workers*/) override {
    trade::TradeRequest request = of(part.units.first);
    append_facts(part, request.facts);
    trade::TradeScene scene(request, {proxies::represent, proxies::representation_error});
    trade::measure_trade(request, scene, folder,
                         [](const std::string& text) { fmt::print(stderr, "{}\n", text); });
    return PartEnd::done;
  }

  std::vector<std::string> row_files() const override { return {}; }

  // Each trade stays a folder of its own.
  Merged merge(std::span<const DonePart> parts, const MergeFolder& folder) override {
    Merged merged;
    for (const DonePart& part : parts) {
      const std::string& name = of(part.units.first).name;
      std::error_code error;
      std::filesystem::create_directories(folder.path, error);
      std::filesystem::copy(
          part.folder, folder.path / name,
          std::filesystem::copy_options::recursive | std::filesystem::copy_options::skip_symlinks,
          error);
      if (error) {
        throw base::InputError(part.folder.string(), 0, "cannot be copied: " + error.message());
      }
      merged.text += fmt::format("{}: measured on {}\n", (folder.path / name / "front.md").string(),
                                 part.machine);
    }
    return merged;
  }

 private:
  const trade::TradeRequest& of(std::int64_t unit) const {
    return requests_[static_cast<std::size_t>(unit)];
  }

  record::Facts facts_of(base::UnitRange units) const {
    record::Facts facts = {{"program", record::hash_of_program()}};
    for (std::int64_t unit = units.first; unit < units.end; ++unit) {
      const trade::TradeRequest& request = of(unit);
      const scene::Scene scene = scene::load_scene(request.scene, request.overrides);
      std::uint64_t hash = 0;
      for (const char c : trade::trade_toml(request, request.scene.parent_path(), ""))
        hash = base::mix(hash ^ static_cast<unsigned char>(c));
      facts.emplace_back("trade " + request.name, base::to_hex(hash) + " " + scene_hash(scene));
    }
    return facts;
  }

  std::string name_;
  std::vector<trade::TradeRequest> requests_;
};

}  // namespace

std::unique_ptr<Work> trade_work(const std::filesystem::path& file,
                                 const std::filesystem::path& home) {
  return std::make_unique<TradeWork>(file, home);
}

}  // namespace touchstone::shards
