// Does the parts of a shard that are not done yet.
#include "harness/shards/shard_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <exception>
#include <system_error>

#include "harness/base/error.h"
#include "harness/process/interrupt.h"
#include "harness/shards/shard_folder.h"
#include "harness/shards/shard_plan.h"

namespace touchstone::shards {
namespace {

// Returns how a part is begun: what another machine measured in part is measured anew, since the
// ratios of a block hold within a machine only.
record::FolderStart start_of(const Work& work, const record::Facts& there) {
  if (there.empty()) return record::FolderStart::overwrite;
  const bool moved = work.is_timed() && record::value_of(there, host_fact) != host_name();
  return moved ? record::FolderStart::overwrite : record::FolderStart::resume;
}

PartEnd run_part(Work& work, const record::Part& part, const std::filesystem::path& folder,
                 int workers) {
  const record::Facts there = facts_of(folder);
  if (record::value_of(there, record::finished_fact) == "yes") return PartEnd::done;
  record::FolderStart start = start_of(work, there);
  if (start == record::FolderStart::resume) {
    try {
      return work.run(part, folder, start, workers);
    } catch (const record::OtherWork& error) {
      // Such as another kernel or another set of processors than before.
      fmt::print(stderr, "touchstone: {}\ntouchstone: the part is done anew\n", error.what());
      start = record::FolderStart::overwrite;
    }
  }
  return work.run(part, folder, start, workers);
}

// A disk that is full takes no row either, and what failed first is what is told.
void note_failure(ShardLock& lock, const std::string& words) {
  try {
    lock.end(Event::failed, words);
  } catch (const base::InputError&) {
  }
}

PartEnd run_parts(Work& work, const ShardPlan& plan, const PlannedShard& shard, int workers) {
  const process::InterruptGuard guard;
  record::Part part{.units = {}, .facts = part_facts(plan.id, shard.shard)};
  (work.is_timed() ? part.facts : part.notes).emplace_back(host_fact, host_name());
  for (const base::UnitRange& units : parts_of(work, shard.units)) {
    part.units = units;
    const std::filesystem::path folder = part_path(shard_path(plan.folder, shard.shard), units);
    if (run_part(work, part, folder, workers) == PartEnd::interrupted) return PartEnd::interrupted;
    if (process::InterruptGuard::raised() && units.end != shard.units.end) {
      return PartEnd::interrupted;
    }
  }
  return PartEnd::done;
}

}  // namespace

std::vector<base::UnitRange> parts_of(const Work& work, base::UnitRange units) {
  if (!work.is_timed()) return {units};
  std::vector<base::UnitRange> parts;
  for (std::int64_t unit = units.first; unit < units.end; ++unit) parts.push_back({unit, unit + 1});
  return parts;
}

record::Facts part_facts(const std::string& plan, std::int64_t shard) {
  return {{"plan", plan}, {"shard", std::to_string(shard)}};
}

record::Facts facts_of(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "machine.csv";
  std::error_code error;
  return std::filesystem::exists(file, error) ? record::read_facts(file) : record::Facts{};
}

ShardEnd run_shard(const std::filesystem::path& folder, std::int64_t number, int workers) {
  const ShardPlan plan = read_plan(folder);
  const PlannedShard& shard = plan.shard(number);
  ShardLock lock(shard_path(folder, number), number);
  const std::vector<Attempt> attempts = read_attempts(shard_path(folder, number));
  if (!attempts.empty() && attempts.back().event == Event::done) return ShardEnd::was_done;
  lock.begin();
  try {
    const std::unique_ptr<Work> work = read_work(plan.campaign(), plan.home);
    work->expect_planned(plan.identity, shard.units);
    if (run_parts(*work, plan, shard, workers) == PartEnd::done) {
      lock.end(Event::done, "");
      return ShardEnd::done;
    }
    const int signal = process::InterruptGuard::signal();
    lock.end(Event::interrupted, signal == 0 ? "" : strsignal(signal));
    return ShardEnd::interrupted;
  } catch (const std::exception& error) {
    note_failure(lock, error.what());
    throw;
  }
}

}  // namespace touchstone::shards
