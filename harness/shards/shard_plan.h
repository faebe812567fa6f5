// The plan of a work in shards: a folder that every machine sees.
//
// The folder holds
// - plan.csv (about,name,value): the plan, and the facts that all shards must share. It is written
//   last: without it there is no plan;
// - shards.csv: the units of each shard, with their estimate;
// - campaign/: a copy of the file that was planned, by its name, which may be that of its work;
// - slurm.sh, parallel.sh, and plan.sh with their variables;
// - shards/N/M: the folder of shard M, N = M / 1000 (harness/shards/shard_folder.h).
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "harness/base/unit_range.h"
#include "harness/shards/work.h"

namespace touchstone::shards {

// The costs of units, of which there may be more than fit into memory: the costs of the first ones,
// which the others repeat.
class Costs {
 public:
  // `period` is not empty, and its values are finite and above 0; `units` is at least 1.
  Costs(const std::vector<double>& period, std::int64_t units);

  std::int64_t units() const { return units_; }
  double of(base::UnitRange range) const { return before(range.end) - before(range.first); }

 private:
  double before(std::int64_t unit) const;  // the sum over the units below it

  std::vector<double> sums_;  // over the first units of a period; one more than it has
  std::int64_t units_;
};

// Returns `shards` ranges, none of them empty, in order, that together are all units, and whose
// greatest cost is the least possible up to a part in 10^6. There are at least as many units as
// shards.
std::vector<base::UnitRange> cut(const Costs& costs, std::int64_t shards);

inline constexpr const char* campaign_folder = "campaign";

struct PlannedShard {
  std::int64_t shard = 0;
  base::UnitRange units;
  double seconds = 0;  // estimate of processor time
};

template <record::row_of<PlannedShard> Row, class Visit>
void columns(Row& row, Visit visit) {
  visit("shard", row.shard, "Number of the shard, from 0.");
  visit("first", row.units.first, "The shard's first unit: a block, a job, a cell or a scene.");
  visit("end", row.units.end, "The unit after its last one.");
  visit(
      "seconds", record::rounded(row.seconds, 4),
      "Estimate of the processor time, seconds; of a campaign and a trade the time of a machine.");
}

struct ShardPlan {
  std::filesystem::path folder;
  std::string id;  // a hash of everything that decides the rows of a shard
  std::string kind, name;
  std::string file;            // name of the file that was planned
  std::filesystem::path home;  // the folder to which the campaign's scenes are relative
  record::Facts identity;      // what every shard must share
  std::vector<PlannedShard> shards;

  std::filesystem::path campaign() const { return folder / campaign_folder / file; }
  // Returns the shard. Throws InputError if there is none with this number.
  const PlannedShard& shard(std::int64_t number) const;
};

// How the scripts of a plan call a shard.
struct ShardSetting {
  std::int64_t shards = 1;
  int cpus = 0;                        // processors of a task; 0: a node of its own
  std::filesystem::path earlier = {};  // results whose times the estimate takes; empty: trials
};

// Plans the work of a file and writes the plan. Throws InputError if there are fewer units than
// shards, if the folder cannot be written, which is found before the trials, or if it holds a plan.
ShardPlan make_plan(const std::filesystem::path& file, const ShardSetting& setting,
                    const std::filesystem::path& folder);
// Reads a plan. Throws InputError if there is none, if it is not whole, or if its name or its file is
// no name of one component.
ShardPlan read_plan(const std::filesystem::path& folder);

}  // namespace touchstone::shards
