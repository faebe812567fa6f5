// Makes, writes and reads plans, and cuts units into ranges by bisection of the greatest cost.
#include "harness/shards/shard_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <system_error>
#include <thread>

#include "harness/base/data_folder.h"
#include "harness/base/error.h"
#include "harness/base/hash.h"
#include "harness/base/input_file.h"
#include "harness/base/names.h"
#include "harness/files/text_file.h"
#include "harness/record/machine.h"

namespace touchstone::shards {
namespace {

// Fills one range after the other up to the cost `most`, and leaves a unit for each range that
// follows. The last range takes what is left, which may cost more.
std::vector<base::UnitRange> fill(const Costs& costs, std::int64_t shards, double most) {
  std::vector<base::UnitRange> ranges;
  std::int64_t first = 0;
  for (std::int64_t shard = 0; shard < shards; ++shard) {
    const std::int64_t end_at_most = costs.units() - (shards - 1 - shard);
    std::int64_t low = first + 1, high = end_at_most;
    if (shard + 1 == shards) low = high;
    while (low < high) {
      const std::int64_t middle = low + (high - low + 1) / 2;
      if (costs.of({first, middle}) <= most) {
        low = middle;
      } else {
        high = middle - 1;
      }
    }
    ranges.push_back({first, low});
    first = low;
  }
  return ranges;
}

double greatest(const Costs& costs, const std::vector<base::UnitRange>& ranges) {
  double cost = 0;
  for (const base::UnitRange& range : ranges) cost = std::max(cost, costs.of(range));
  return cost;
}

}  // namespace

Costs::Costs(const std::vector<double>& period, std::int64_t units) : units_(units) {
  sums_.push_back(0);
  for (const double cost : period) sums_.push_back(sums_.back() + cost);
}

double Costs::before(std::int64_t unit) const {
  const auto period = static_cast<std::int64_t>(sums_.size()) - 1;
  return static_cast<double>(unit / period) * sums_.back() +
         sums_[static_cast<std::size_t>(unit % period)];
}

std::vector<base::UnitRange> cut(const Costs& costs, std::int64_t shards) {
  constexpr double precision = 1e-6;
  double high = costs.of({0, costs.units()});
  double low = high / static_cast<double>(shards);
  std::vector<base::UnitRange> best = fill(costs, shards, low);
  high = greatest(costs, best);
  while (high - low > precision * high) {
    const double middle = (low + high) / 2;
    std::vector<base::UnitRange> ranges = fill(costs, shards, middle);
    const double cost = greatest(costs, ranges);
    if (cost < high) {
      high = cost;
      best = std::move(ranges);
    }
    // Nothing below `middle` is possible where even filling up to it leaves too much for the last.
    if (cost > middle) {
      low = middle;
    } else {
      high = std::min(high, middle);
    }
  }
  return best;
}

namespace {

// A row of plan.csv.
struct Fact {
  std::string about;  // "plan" or "work"
  std::string name, value;
};

template <record::row_of<Fact> Row, class Visit>
void columns(Row& row, Visit visit) {
  visit("about", row.about, "`plan`: the plan itself; `work`: what every shard must share.");
  visit("name", row.name, "Name of the fact.");
  visit("value", row.value, "Its value.");
}

constexpr const char* plan_file = "plan.csv";
constexpr const char* shards_file = "shards.csv";

// Sets what a row of plan.csv says. Throws InputError with its line.
void take_fact(ShardPlan& plan, Fact fact, const files::CsvReader::Row& row) {
  if (fact.about == "work") {
    plan.identity.emplace_back(std::move(fact.name), std::move(fact.value));
  } else if (fact.name == "id") {
    plan.id = fact.value;
  } else if (fact.name == "kind") {
    plan.kind = fact.value;
  } else if (fact.name == "name") {
    const std::string fault = base::name_fault(fact.value);
    if (!fault.empty()) row.fail("name: " + fault);
    plan.name = fact.value;
  } else if (fact.name == "file") {
    if (!base::is_component(fact.value)) {
      row.fail(fmt::format("file: found '{}'; expected the name of a file in {}",
                           base::shortened(fact.value), campaign_folder));
    }
    plan.file = fact.value;
  } else if (fact.name == "home") {
    plan.home = fact.value;
  }
}

// Units that belong together are cut as one.
std::vector<base::UnitRange> atoms_of(const Work& work, const std::vector<double>& seconds) {
  std::vector<base::UnitRange> atoms;
  for (std::int64_t unit = 0; std::cmp_less(unit, seconds.size()); ++unit) {
    if (!atoms.empty() && work.belongs_to_previous(unit)) {
      ++atoms.back().end;
    } else {
      atoms.push_back({unit, unit + 1});
    }
  }
  return atoms;
}

std::vector<PlannedShard> cut_work(const Work& work, const ShardSetting& setting,
                                   const std::string& file) {
  const std::int64_t shards = setting.shards;
  const std::vector<double> seconds = work.estimate(setting.earlier);
  const bool is_listed = std::cmp_equal(seconds.size(), work.units());
  const std::vector<base::UnitRange> atoms =
      is_listed ? atoms_of(work, seconds) : std::vector<base::UnitRange>{};
  const std::int64_t most = is_listed ? static_cast<std::int64_t>(atoms.size()) : work.units();
  if (shards > most) {
    throw base::InputError(file, 0,
                           fmt::format("has {} part{} that can be done apart; expected at most as "
                                       "many --shards, and not {}",
                                       most, most == 1 ? "" : "s", shards));
  }
  std::vector<PlannedShard> plan;
  const auto add = [&](base::UnitRange units, double cost) {
    plan.push_back({static_cast<std::int64_t>(plan.size()), units, cost});
  };
  if (!is_listed) {
    const Costs costs(seconds, work.units());
    for (const base::UnitRange& range : cut(costs, shards)) add(range, costs.of(range));
    return plan;
  }
  std::vector<double> of_atoms;
  for (const base::UnitRange& atom : atoms) {
    double cost = 0;
    for (std::int64_t unit = atom.first; unit < atom.end; ++unit)
      cost += seconds[static_cast<std::size_t>(unit)];
    of_atoms.push_back(cost);
  }
  const Costs costs(of_atoms, most);
  for (const base::UnitRange& range : cut(costs, shards)) {
    add({atoms[static_cast<std::size_t>(range.first)].first,
         atoms[static_cast<std::size_t>(range.end - 1)].end},
        costs.of(range));
  }
  return plan;
}

std::string id_of(const ShardPlan& plan, const std::string& campaign) {
  std::uint64_t hash = 0;
  const auto add = [&](const std::string& text) {
    for (const char c : text) hash = base::mix(hash ^ static_cast<unsigned char>(c));
    hash = base::mix(hash);
  };
  add(plan.kind);
  add(campaign);
  for (const auto& [name, value] : plan.identity) {
    add(name);
    add(value);
  }
  for (const PlannedShard& shard : plan.shards) add(to_string(shard.units));
  return base::to_hex(hash);
}

// Returns the minutes after which a scheduler may stop a shard: twice the estimate of the longest
// one, and five for what estimates leave out.
std::int64_t time_limit(const ShardPlan& plan, const Work& work, int cpus) {
  double longest = 0;
  for (const PlannedShard& shard : plan.shards) longest = std::max(longest, shard.seconds);
  const unsigned processors =
      cpus > 0 ? static_cast<unsigned>(cpus) : std::max(1u, std::thread::hardware_concurrency());
  if (!work.is_timed()) longest /= processors;
  return static_cast<std::int64_t>(std::ceil(2 * longest / 60)) + 5;
}

void write_scripts(const ShardPlan& plan, const Work& work, int cpus) {
  const std::filesystem::path program =
      std::filesystem::read_symlink("/proc/self/exe").parent_path() / "touchstone";
  const std::filesystem::path folder = std::filesystem::absolute(plan.folder).lexically_normal();
  std::string text = "# The variables of slurm.sh and parallel.sh.\n";
  const auto add = [&](const char* name, const std::string& value) {
    text += fmt::format("{}={}\n", name, base::shell_word(value));
  };
  add("PROGRAM", program.string());
  add("PLAN", folder.string());
  add("NAME", plan.name);
  add("SHARDS", std::to_string(plan.shards.size()));
  add("MINUTES", std::to_string(time_limit(plan, work, cpus)));
  add("CPUS", cpus > 0 ? std::to_string(cpus) : "");
  files::write_text(plan.folder / "plan.sh", text);
  const std::filesystem::path scripts = base::data_folder().path / "harness/shards";
  for (const char* name : {"slurm.sh", "parallel.sh"}) {
    files::write_text(plan.folder / name, files::read_text(scripts / name));
    std::filesystem::permissions(plan.folder / name,
                                 std::filesystem::perms::owner_exec |
                                     std::filesystem::perms::group_exec |
                                     std::filesystem::perms::others_exec,
                                 std::filesystem::perm_options::add);
  }
}

}  // namespace

const PlannedShard& ShardPlan::shard(std::int64_t number) const {
  if (number < 0 || std::cmp_greater_equal(number, shards.size())) {
    throw base::InputError(folder.string(), 0,
                           fmt::format("has the shards 0 to {}; expected one of them, and not {}",
                                       shards.size() - 1, number));
  }
  return shards[static_cast<std::size_t>(number)];
}

ShardPlan make_plan(const std::filesystem::path& file, const ShardSetting& setting,
                    const std::filesystem::path& folder) {
  std::error_code error;
  if (std::filesystem::exists(folder / plan_file, error)) {
    throw base::InputError((folder / plan_file).string(), 0,
                           "is the plan of other work; expected another --out");
  }
  const std::unique_ptr<Work> work = read_work(file);
  const std::string campaign = files::read_text(file);
  record::expect_writable(folder);  // before the trials that the estimate takes
  ShardPlan plan{.folder = folder,
                 .id = {},
                 .kind = std::string(work->kind()),
                 .name = work->name(),
                 .file = file.filename().string(),
                 .home = std::filesystem::absolute(file).lexically_normal().parent_path(),
                 .identity = work->identity(),
                 .shards = cut_work(*work, setting, file.string())};
  plan.id = id_of(plan, campaign);
  std::filesystem::create_directories(folder / "logs", error);
  if (!error) std::filesystem::create_directories(folder / campaign_folder, error);
  if (error) throw base::InputError(folder.string(), 0, "cannot be made: " + error.message());
  files::write_text(plan.campaign(), campaign);
  record::write_rows(folder / shards_file, plan.shards);
  write_scripts(plan, *work, setting.cpus);
  std::vector<Fact> facts = {{"plan", "id", plan.id},
                             {"plan", "kind", plan.kind},
                             {"plan", "name", plan.name},
                             {"plan", "file", plan.file},
                             {"plan", "home", plan.home.string()},
                             {"plan", "made", record::date_now()}};
  for (const auto& [name, value] : plan.identity) facts.push_back({"work", name, value});
  record::write_rows(folder / plan_file, facts);
  return plan;
}

ShardPlan read_plan(const std::filesystem::path& folder) {
  std::error_code error;
  if (!std::filesystem::exists(folder / plan_file, error)) {
    throw base::InputError(
        folder.string(), 0,
        "holds no whole plan; expected a folder that `touchstone shards plan` made");
  }
  ShardPlan plan;
  plan.folder = folder;
  record::reader_of<Fact>(folder / plan_file).read([&](const files::CsvReader::Row& row) {
    take_fact(plan, record::read_row<Fact>(row), row);
  });
  plan.shards = record::read_rows<PlannedShard>(folder / shards_file);
  const std::string id = id_of(plan, files::read_text(plan.campaign()));
  if (plan.shards.empty() || id != plan.id) {
    throw base::InputError(
        (folder / plan_file).string(), 0,
        fmt::format("is of another plan than the files beside it ({}, and they "
                    "make {}); expected those that `touchstone shards plan` wrote",
                    plan.id, id));
  }
  return plan;
}

}  // namespace touchstone::shards
