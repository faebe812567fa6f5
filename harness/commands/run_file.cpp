// touchstone run: a shard of a plan, or a file with a table [trade] or [check], or a [[group]] of a kind.
#include <fmt/format.h>
#include <sched.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include "harness/base/error.h"
#include "harness/cells/read_cells.h"
#include "harness/check/check_file.h"
#include "harness/commands/advise.h"
#include "harness/commands/arguments.h"
#include "harness/commands/commands.h"
#include "harness/commands/pictures.h"
#include "harness/commands/run_file.h"
#include "harness/commands/shared_options.h"
#include "harness/files/toml_table.h"
#include "harness/shards/shard_folder.h"
#include "harness/stats/cell_tables.h"

namespace touchstone::commands {
namespace {

// Returns the number of processors that this process may use, which a scheduler may have limited.
int processors() {
  cpu_set_t mask;
  return sched_getaffinity(0, sizeof mask, &mask) == 0 ? std::max(1, CPU_COUNT(&mask)) : 1;
}

// Returns how many processes share the work.
int workers(const RunFileOptions& options) {
  if (options.threads.size() > 1) {
    throw base::InputError("--threads: found several numbers; expected one with such work");
  }
  return options.threads.empty() ? processors() : options.threads.front();
}

int run_shard(const RunFileOptions& options) {
  switch (shards::run_shard(options.plan, options.shard, workers(options))) {
    case shards::ShardEnd::was_done:
      fmt::print("shard {} was done before\n", options.shard);
      return exit_done;
    case shards::ShardEnd::interrupted:
      fmt::print(
          stderr,
          "touchstone: interrupted; what was done is kept, and the same command goes on with "
          "it\n");
      return exit_bad_request;
    case shards::ShardEnd::done: break;
  }
  fmt::print("shard {} is done\n", options.shard);
  return exit_done;
}

int run_trades(const RunFileOptions& options) {
  if (options.resume) {
    throw base::InputError(options.file +
                           " has a table [trade], and a trade begins anew; expected no --resume");
  }
  int status = exit_done;
  const std::vector<trade::TradeRequest> requests = trade::read_trades(options.file);
  for (const trade::TradeRequest& request : requests) {
    const bool several = requests.size() > 1;
    const std::filesystem::path folder = !options.out.empty() && several
                                             ? std::filesystem::path(options.out) / request.name
                                             : trade_folder(options.out, request.name);
    status = std::max(status, run_trade(request, folder, true));
    if (options.with_page) make_page(folder);
  }
  return status;
}

int run_check_file(const RunFileOptions& options) {
  auto [name, request] = check::read_check_file(options.file);
  const std::filesystem::path folder = results_folder(options.out, name);
  request.out = folder;
  request.resume = options.resume;
  request.workers = workers(options);
  const check::CheckEnd end = check::run_and_tell(request);
  if (end.interrupted) return end_interrupted();
  print_summary(folder, fmt::format("{}\nRows in {}\n", end.text, folder.string()));
  if (options.with_page) make_page(folder);
  return end.ours_wrong ? exit_measured_wrong : exit_done;
}

int run_cells(const RunFileOptions& options) {
  const cells::CellRequest request = cells::read_cells(options.file);
  const std::filesystem::path folder = results_folder(options.out, request.name);
  const cells::CellRunResult result =
      cells::run_cells(request, folder, record::resume_or_overwrite(options.resume),
                       [](const std::string& line) { fmt::print(stderr, "{}\n", line); });
  if (result.interrupted) return end_interrupted();
  print_summary(
      folder, fmt::format("{}Tables in {}\n",
                          stats::write_cell_tables(folder, request.name, folder), folder.string()));
  if (options.with_page) make_page(folder);
  return result.ours_wrong ? exit_measured_wrong : exit_done;
}

// The tables that make a file no campaign of scenes, at its top or in a [[group]].
bool is_of_scenes(const std::string& file) {
  constexpr auto keys =
      std::to_array<std::string_view>({"trade", "check", "stress", "soak", "kind", "cells"});
  return std::ranges::none_of(keys, [&](std::string_view key) {
    return files::has_key(file, key) || files::has_key(file, "group." + std::string(key));
  });
}

std::optional<int> run_file(const RunFileOptions& options) {
  if (!options.plan.empty()) return run_shard(options);
  if (is_of_scenes(options.file)) return std::nullopt;
  if (!options.others.empty()) {
    throw base::InputError(
        fmt::format("{} is no campaign of scenes, and {} was given; expected no options but --out, "
                    "--resume, --threads and --report with such a file",
                    options.file, options.others.front()));
  }
  const bool is_of_cells = cells::has_cells(options.file);
  if (!is_of_cells && check::has_check(options.file)) return run_check_file(options);
  if (!options.threads.empty()) {
    throw base::InputError(
        "--threads was given; expected it with a shard, or a table [check] alone");
  }
  return is_of_cells ? run_cells(options) : run_trades(options);
}

}  // namespace

void add_run_of_any(Arguments command) {
  static constexpr WholeRun whole = {
      run_file, [](const std::vector<std::string>& peers) { return start_peers(peers); }};
  add_run(command, whole);
}

}  // namespace touchstone::commands
