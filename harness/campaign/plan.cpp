// Plans a campaign by trials of a few frames and pairs.
#include "harness/campaign/plan.h"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "harness/base/clock.h"
#include "harness/campaign/blocks.h"
#include "harness/campaign/check_pass/check_price.h"
#include "harness/campaign/schedule.h"
#include "harness/stats/samples.h"

namespace touchstone::campaign {
namespace {

constexpr int planned_frames = 2;

}  // namespace

std::vector<PlannedBlock> plan_campaign(const Campaign& campaign) {
  const CampaignBlocks blocks(campaign);
  std::vector<PlannedBlock> plan;
  for (std::int64_t number = 0; number < blocks.size(); ++number) {
    const RunContext context = blocks.context(number, nullptr);
    const CampaignGroup& group = *context.block->group;
    const IsaGuard guard(*context.block);
    PlannedBlock& planned = plan.emplace_back();
    planned.label = blocks.label(number);
    planned.seconds = group.seconds;
    const auto add = [&](std::string name, std::vector<std::string> contestants) {
      if (!contestants.empty()) planned.sets.push_back({std::move(name), std::move(contestants)});
    };
    std::vector<std::string> broad;
    for (const BroadPhaseEntry* entry : context.broad()) broad.push_back(entry->info.name);
    std::vector<std::string> listed;
    const auto list = [&](std::vector<std::string>& labels, const std::string& algorithm) {
      for (const auto executor : context.executors())
        labels.push_back(record::label_on(algorithm, executor));
    };
    for (const std::string& name : broad) list(listed, name);
    if (group.limit && !broad.empty()) list(listed, stats::limit_label);
    add("broad phases", listed);
    // Without narrow phases the first frames determine the time of all.
    const bool has_pairs = context.has_narrow();
    scene::Scene scene = *context.scene;
    const auto frames = static_cast<std::size_t>(
        scene.recording.empty() ? scene.frames : static_cast<int>(scene.recording.size()));
    if (!has_pairs) {
      scene.frames = std::min(scene.frames, planned_frames);
      if (!scene.recording.empty()) {
        scene.recording.resize(std::min<std::size_t>(frames, planned_frames));
      }
    }
    const base::Stopwatch watch;
    const measure::BlockInput input(scene, context.block->boxes, has_pairs);
    planned.check_seconds =
        watch.seconds() * static_cast<double>(frames) / static_cast<double>(input.frames.size());
    std::vector<measure::NarrowSet> sets;
    if (has_pairs) sets = context.true_sets(input);
    planned.check_seconds += price_of_check(context, input, frames, sets);
    if (!has_pairs) continue;
    if (!context.finds_pairs()) broad.assign(1, "");
    for (const std::string& source : broad) {
      for (const measure::NarrowSet& set : sets) {
        std::vector<std::string> narrow;
        for (const measure::NarrowChoice* choice : group.choices()) {
          if (offer(*choice, set, input) == measure::Offer::taken &&
              context.admits(*choice, source, set.task, set.kind_name())) {
            list(narrow, choice->label());
          }
        }
        add(fmt::format("{} {}{}{}", to_string(set.task), set.kind_name(),
                        source.empty() ? "" : " on the pairs of ", source),
            std::move(narrow));
      }
    }
  }
  return plan;
}

}  // namespace touchstone::campaign
