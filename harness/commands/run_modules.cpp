// Adds modules to a campaign.
#include "harness/commands/run_modules.h"

#include <fmt/format.h>

#include <algorithm>

#include "harness/base/error.h"
#include "harness/kinds/selection.h"
#include "harness/modules/file_word.h"

namespace touchstone::commands {
namespace {

template <class Entry>
std::vector<const Entry*> entries_of(const std::string& file) {
  std::vector<const Entry*> found;
  for (const Entry& entry : registry::entries<Entry>()) {
    if (registry::module_of(entry.info) == file) found.push_back(&entry);
  }
  return found;
}

template <class Choice>
std::vector<Precision> scalars_of(const std::vector<Choice>& choices) {
  std::vector<Precision> scalars;
  for (const Choice& choice : choices) {
    const Precision scalar = choice.settings.scalar;
    if (std::ranges::find(scalars, scalar) == scalars.end()) scalars.push_back(scalar);
  }
  return scalars;
}

// Adds what the module offers to the group: of each kind that the group asks, in the scalars that it asks. Returns how
// much that is.
std::size_t add_module(const std::string& file, campaign::CampaignGroup& group) {
  std::size_t added = 0;
  if (!group.broad.empty()) {
    for (const BroadPhaseEntry* entry : entries_of<BroadPhaseEntry>(file)) {
      ++added;
      if (std::ranges::find(group.broad, entry) == group.broad.end()) group.broad.push_back(entry);
    }
  }
  const auto add_choices = [&](std::vector<measure::NarrowChoice>& choices,
                               const std::vector<measure::NarrowChoice>& more) {
    for (const measure::NarrowChoice& choice : more) {
      ++added;
      if (std::ranges::find(choices, choice.label(), &measure::NarrowChoice::label) ==
          choices.end())
        choices.push_back(choice);
    }
  };
  std::vector<measure::NarrowChoice> narrow;
  for (const NarrowPhaseEntry* entry : entries_of<NarrowPhaseEntry>(file)) {
    for (const Precision scalar : scalars_of(group.narrow)) {
      if (offers(*entry, scalar))
        narrow.push_back({entry, {.scalar = scalar}, false, measure::usual_batch});
    }
  }
  add_choices(group.narrow, narrow);
  add_choices(group.concave, measure::concave_choices(entries_of<ConcaveEntry>(file), {},
                                                      scalars_of(group.concave)));
  return added;
}

}  // namespace

void add_modules(const std::string& words, campaign::Campaign& campaign) {
  if (words.empty()) return;
  for (const std::string& word : kinds::split_names(words)) {
    std::size_t added = 0;
    for (campaign::CampaignGroup& group : campaign.groups) {
      added += add_module(modules::file_of(word), group);
    }
    if (added > 0) continue;
    throw base::InputError(fmt::format(
        "--with {}: it offers none of the kinds and scalars that the campaign measures; expected "
        "one of them",
        word));
  }
}

void add_measured_modules(const campaign::Campaign& campaign, std::vector<std::string>& names) {
  const auto add = [&](const AlgorithmInfo& info) {
    if (info.origin == Origin::module && std::ranges::find(names, info.name) == names.end())
      names.push_back(info.name);
  };
  for (const campaign::CampaignGroup& group : campaign.groups) {
    for (const BroadPhaseEntry* entry : group.broad) add(entry->info);
    for (const measure::NarrowChoice* choice : group.choices()) add(choice->info());
  }
}

}  // namespace touchstone::commands
