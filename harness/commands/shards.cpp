// touchstone shards plan: cuts a campaign, a trade or a check into shards. touchstone shards merge:
// joins the shards of a plan. touchstone shards status: how far they are.
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "harness/base/names.h"
#include "harness/commands/arguments.h"
#include "harness/commands/commands.h"
#include "harness/commands/shared_options.h"
#include "harness/shards/merge.h"
#include "harness/shards/shard_plan.h"
#include "harness/shards/status.h"

namespace touchstone::commands {
namespace {

struct PlanOptions {
  std::string campaign, out, earlier;
  shards::ShardSetting setting;
};

int plan(PlanOptions& options) {
  options.setting.earlier = options.earlier;
  const shards::ShardPlan plan = shards::make_plan(options.campaign, options.setting, options.out);
  double total = 0, longest = 0;
  for (const shards::PlannedShard& shard : plan.shards) {
    total += shard.seconds;
    longest = std::max(longest, shard.seconds);
  }
  fmt::print("{} ({}): {} units in {} shards; about {:.3g} h in all, {:.3g} h the longest shard\n",
             plan.name, plan.kind, plan.shards.back().units.end, plan.shards.size(), total / 3600,
             longest / 3600);
  const std::string folder = base::shell_word(plan.folder.string());
  fmt::print(
      "on a cluster:       {1}\n"
      "on some machines:   {2}\n"
      "one shard:          touchstone run --plan {0} --shard 0\n"
      "how far it is:      touchstone shards status {0}\n"
      "all results in one: touchstone shards merge {0} --out RESULTS\n",
      folder, base::shell_word((plan.folder / "slurm.sh").string()),
      base::shell_word((plan.folder / "parallel.sh").string()));
  return exit_done;
}

}  // namespace

void add_shards_plan(Arguments command) {
  const auto options = std::make_shared<PlanOptions>();
  command
      .text("campaign", options->campaign, "A campaign, or a file with a table [trade] or [check]")
      .is_read()
      .required();
  command.number("--shards", options->setting.shards, "Number of shards")
      .within(1, 10'000'000)
      .required();
  command.text("--out", options->out, "Folder for the plan and its shards, which all machines see")
      .required();
  command.text(
      "--from", options->earlier,
      "Results of an earlier run of the campaign, whose times the estimate takes instead of "
      "trials");
  command
      .number("--cpus", options->setting.cpus,
              "Processors of a shard's task (default: a node of its own)")
      .within(1, 4096);
  command.job([options] { return plan(*options); });
}

namespace {

struct MergeOptions {
  std::string plan, out;
  shards::MergeSetting setting;
};

int merge(const MergeOptions& options) {
  constexpr std::size_t most_lines = 20;
  const std::filesystem::path plan = options.plan;
  const std::filesystem::path out =
      options.out.empty() ? plan / "results" : std::filesystem::path(options.out);
  const shards::MergeResult result = shards::merge_plan(plan, out, options.setting);
  if (!result.missing.empty()) {
    for (std::size_t i = 0; i < std::min(most_lines, result.missing.size()); ++i)
      fmt::print(stderr, "touchstone: {}\n", result.missing[i]);
    if (result.missing.size() > most_lines)
      fmt::print(stderr, "touchstone: and {} more\n", result.missing.size() - most_lines);
    fmt::print(stderr, "touchstone: {} shards are missing{}; to run them: {} {}\n",
               result.missing.size(), result.written ? "" : ", and nothing was written",
               base::shell_word((plan / "slurm.sh").string()), result.missing_list);
    if (!result.written) return exit_bad_request;
  }
  print_summary(out,
                fmt::format("{}\n{} in {}\n", result.merged.text,
                            result.missing.empty() ? "Results" : "Partial results", out.string()));
  return result.merged.ours_wrong ? exit_measured_wrong : exit_done;
}

int status(const std::string& folder) {
  const shards::ShardPlan plan = shards::read_plan(folder);
  fmt::print("{}", shards::status_text(plan, shards::status_of(plan)));
  return exit_done;
}

}  // namespace

void add_shards_merge(Arguments command) {
  const auto options = std::make_shared<MergeOptions>();
  command.text("plan", options->plan, "Folder of the plan").required();
  command.text("--out", options->out, "Folder for the results (default: results in the plan's)");
  command.flag("--zstd", options->setting.zstd,
               "Pack the files of rows, as NAME.csv.zst, which the other commands read too");
  command.flag("--overwrite", options->setting.overwrite,
               "Replace what the folder holds, even if it is not of this plan");
  command.flag("--partial", options->setting.partial,
               "Join the shards that are done; machine.csv tells which are missing");
  command.job([options] { return merge(*options); });
}

void add_shards_status(Arguments command) {
  const auto plan = std::make_shared<std::string>();
  command.text("plan", *plan, "Folder of the plan").required();
  command.job([plan] { return status(*plan); });
}

}  // namespace touchstone::commands
