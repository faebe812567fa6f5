// The rules and the description of a campaign.
#include "harness/campaign/campaign.h"

#include <fmt/format.h>

#include <algorithm>

#include "harness/base/hash.h"
#include "harness/modules/modules.h"
#include "harness/record/machine.h"
#include "harness/record/raw_row.h"

namespace touchstone::campaign {
namespace {

// "hulls_8" is also a name of "hulls_8 gap 0.1".
bool is_called(std::string_view scene, std::string_view name) {
  if (!scene.starts_with(name)) return false;
  const std::string_view rest = scene.substr(name.size());
  return rest.empty() || rest.starts_with(" gap ") || rest.starts_with(" depth ");
}

bool is_about(const CampaignRule& rule, const CampaignCell& cell) {
  const bool narrow = !cell.narrow.empty();
  const auto names = [](const auto& wanted, const auto& value) {
    return !wanted || *wanted == value;
  };
  return (!rule.broad || (!narrow && *rule.broad == cell.broad)) &&
         (!rule.narrow || names(rule.narrow, cell.narrow) ||
          cell.narrow.starts_with(*rule.narrow + " ")) &&
         (!rule.scene || is_called(cell.scene, *rule.scene)) &&
         (!rule.scalar || rule.scalar == cell.scalar) && (!rule.task || rule.task == cell.task) &&
         names(rule.pair_kind, cell.pair_kind) && names(rule.boxes, cell.boxes) &&
         names(rule.threads, cell.threads) && (!rule.warm || rule.warm == cell.warm) &&
         (!rule.batch || rule.batch == cell.batch) &&
         (!rule.counts_above || cell.bodies > *rule.counts_above) &&
         (!rule.counts_below || cell.bodies < *rule.counts_below);
}

std::string describe(const CampaignRule& rule) {
  std::string text = "{";
  const auto add = [&](const char* name, const auto& value) {
    if (value) text += fmt::format(" {}={}", name, *value);
  };
  const auto named = [&](const char* name, const auto& value) {
    if (value) text += fmt::format(" {}={}", name, to_string(*value));
  };
  add("broad", rule.broad);
  add("narrow", rule.narrow);
  add("scene", rule.scene);
  named("scalar", rule.scalar);
  named("task", rule.task);
  add("pair_kind", rule.pair_kind);
  named("boxes", rule.boxes);
  add("threads", rule.threads);
  add("warm", rule.warm);
  add("batch", rule.batch);
  add("counts_above", rule.counts_above);
  add("counts_below", rule.counts_below);
  return text + " }";
}

}  // namespace

bool CampaignGroup::admits(const CampaignCell& cell) const {
  const auto about = [&](const CampaignRule& rule) { return is_about(rule, cell); };
  return (include.empty() || std::ranges::any_of(include, about)) &&
         std::ranges::none_of(exclude, about);
}

std::vector<const measure::NarrowChoice*> CampaignGroup::choices() const {
  std::vector<const measure::NarrowChoice*> all;
  for (const measure::NarrowChoice& choice : narrow) all.push_back(&choice);
  for (const measure::NarrowChoice& choice : concave) all.push_back(&choice);
  return all;
}

std::string description(const Campaign& campaign) {
  std::string text = fmt::format("{} seed {}\n", campaign.name, campaign.seed);
  for (const CampaignGroup& group : campaign.groups) {
    text += "group";
    for (const auto& scene : group.scenes) text += " " + scene.filename().string();
    text += fmt::format(" counts {} seeds {} frames {} threads {} rebuild {} pairing {}",
                        fmt::join(group.counts, ","), fmt::join(group.seeds, ","), group.frames,
                        fmt::join(group.threads, ","), group.rebuild,
                        group.pairing == Pairing::product ? "product" : "separate");
    for (const auto& gap : group.gaps) {
      if (gap) text += fmt::format(" gap {}", *gap);
    }
    for (const scene::BoxKind boxes : group.boxes)
      text += fmt::format(" boxes {}", to_string(boxes));
    for (const auto& limit : group.isa) {
      if (limit) text += fmt::format(" isa {}", to_string(*limit));
    }
    for (const auto* entry : group.broad) text += " broad " + entry->info.name;
    for (const measure::NarrowChoice& choice : group.narrow) {
      text += fmt::format(" narrow {} {} {} {} {}", choice.entry->info.name,
                          to_string(choice.settings.scalar), choice.settings.tolerance.value_or(0),
                          choice.settings.duality_gap.value_or(0),
                          choice.settings.max_iterations.value_or(0));
      if (choice.warm) text += " warm";
      if (choice.batch != measure::usual_batch) text += fmt::format(" by {}", choice.batch);
    }
    for (const measure::NarrowChoice& choice : group.concave) {
      text += fmt::format(" concave {} {}", choice.name(), to_string(choice.settings.scalar));
    }
    for (const record::QueryTask task : group.tasks)
      text += fmt::format(" task {}", to_string(task));
    for (const CampaignRule& rule : group.include) text += " include " + describe(rule);
    for (const CampaignRule& rule : group.exclude) text += " exclude " + describe(rule);
    text += fmt::format(" time_limit {} memory_limit {} width {} seconds {} squares {}",
                        group.time_limit, group.memory_limit, group.width, group.seconds,
                        group.squares.value_or(0));
    if (group.limit) text += " limit";
    for (const ExecutorKind kind : group.executors) {
      if (group.executors.size() > 1 || kind != ExecutorKind::crew)
        text += fmt::format(" executor {}", to_string(kind));
    }
    if (group.rounds) text += fmt::format(" rounds {}", *group.rounds);
    if (group.processes != 3) text += fmt::format(" processes {}", group.processes);
    text += "\n";
  }
  return text;
}

std::vector<std::pair<std::string, std::string>> campaign_identity(
    const Campaign& campaign, const std::map<std::string, std::string>& scene_hashes) {
  std::uint64_t hash = 0;
  for (const char c : description(campaign)) hash = base::mix(hash ^ static_cast<unsigned char>(c));
  std::vector<std::pair<std::string, std::string>> facts = {{"campaign", campaign.name},
                                                            {"seed", std::to_string(campaign.seed)},
                                                            {"campaign_hash", base::to_hex(hash)}};
  facts.emplace_back("program", record::hash_of_program());
  for (auto& fact : modules::facts()) facts.push_back(std::move(fact));
  for (const auto& [name, value] : scene_hashes) facts.emplace_back("scene " + name, value);
  return facts;
}

std::vector<std::pair<std::string, std::string>> campaign_facts(
    const Campaign& campaign, const std::map<std::string, std::string>& scene_hashes) {
  auto facts = campaign_identity(campaign, scene_hashes);
  for (auto& fact : record::machine_facts()) facts.push_back(std::move(fact));
  return facts;
}

}  // namespace touchstone::campaign
