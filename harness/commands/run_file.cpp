// touchstone run: a shard of a plan, or a file with a table [trade] or [check], or a [[group]] of a kind.
#include <fmt/format.h>
#include <sched.h>

#include <algorithm>
#include <memory>

#include "harness/base/error.h"
#include "harness/cells/read_cells.h"
#include "harness/check/check_file.h"
#include "harness/commands/advise.h"
#include "harness/commands/arguments.h"
#include "harness/commands/commands.h"
#include "harness/commands/pictures.h"
#include "harness/commands/shared_options.h"
#include "harness/shards/shard_folder.h"
#include "harness/stats/cell_tables.h"

namespace touchstone::commands {
namespace {

// Returns the number of processors that this process may use, which a scheduler may have limited.
int processors() {
  cpu_set_t mask;
  return sched_getaffinity(0, sizeof mask, &mask) == 0 ? std::max(1, CPU_COUNT(&mask)) : 1;
}

struct RunFileOptions {
  std::string file, out, plan;
  std::int64_t shard = -1;
  int threads = processors();
  bool with_page = false, resume = false;
};

int run_shard(const RunFileOptions& options) {
  switch (shards::run_shard(options.plan, options.shard, options.threads)) {
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
  request.workers = options.threads;
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

int run_file(const RunFileOptions& options, const Option& threads) {
  if (!options.plan.empty()) return run_shard(options);
  const bool is_of_cells = cells::has_cells(options.file);
  if (!is_of_cells && check::has_check(options.file)) return run_check_file(options);
  expect_not_given({threads}, "with a shard, or a table [check] alone");
  return is_of_cells ? run_cells(options) : run_trades(options);
}

}  // namespace

void add_run_file(Arguments command) {
  const auto options = std::make_shared<RunFileOptions>();
  const Option file =
      command.text("campaign", options->file,
                   "A file with a table [trade] or [check], or a [[group]] of a kind");
  command.text("--out", options->out, "Folder (default: results/local/NAME in the project)")
      .needs(file);
  command
      .flag("--report", options->with_page, "Make a page of the results, report.html in the folder")
      .needs(file);
  command
      .flag("--resume", options->resume,
            "Go on with the work that was stopped in the folder of --out; not for trades")
      .needs(file);
  add_shard(command, options->plan, options->shard).excludes(file);
  const Option threads = add_threads(command, options->threads,
                                     "Processes that share a check (default: one a processor)");
  command.job([options, threads] { return run_file(*options, threads); });
}

}  // namespace touchstone::commands
