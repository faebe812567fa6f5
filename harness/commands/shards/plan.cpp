// touchstone shards plan: cuts a campaign, a trade or a check into shards.
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "harness/base/shell_word.h"
#include "harness/commands/arguments.h"
#include "harness/commands/commands.h"
#include "harness/shards/shard_plan.h"

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

}  // namespace touchstone::commands
