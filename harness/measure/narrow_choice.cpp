// The label of a phase with its settings, and what it takes.
#include "harness/measure/narrow_choice.h"

#include <algorithm>
#include <limits>

#include "harness/record/raw_row.h"

namespace touchstone::measure {

std::string NarrowChoice::name() const {
  const bool with_mid = concave != nullptr && concave->takes_mid_phase;
  return with_mid ? info().name + " " + mid->info.name : info().name;
}

std::string NarrowChoice::label() const {
  return record::narrow_label(
      name(), to_string(settings.scalar), settings.tolerance.value_or(Outcome::none),
      settings.duality_gap.value_or(Outcome::none), warm, batch == usual_batch ? -1 : batch);
}

std::unique_ptr<ConcavePhase> NarrowChoice::make_concave(
    std::span<const ConcaveBody> bodies) const {
  std::unique_ptr<ConcavePhase> phase =
      concave->make({.scalar = settings.scalar, .mid_phase = mid->make, .narrow_phase = [] {
                       return registry::find<NarrowPhaseEntry>("certified")->make({});
                     }});
  phase->bind(bodies);
  return phase;
}

std::vector<NarrowChoice> concave_choices(std::span<const ConcaveEntry* const> entries,
                                          std::span<const MidPhaseEntry* const> mids,
                                          std::span<const Precision> scalars) {
  const std::vector<const MidPhaseEntry*> usual = {registry::find<MidPhaseEntry>(usual_mid_phase)};
  std::vector<NarrowChoice> choices;
  for (const ConcaveEntry* entry : entries) {
    for (const Precision scalar : scalars) {
      if (std::ranges::find(entry->scalars, scalar) == entry->scalars.end()) continue;
      for (const MidPhaseEntry* mid : entry->takes_mid_phase ? mids : std::span(usual)) {
        choices.push_back({.settings = {.scalar = scalar}, .concave = entry, .mid = mid});
      }
    }
  }
  return choices;
}

Offer offer(const NarrowChoice& choice, const NarrowSet& set, const BlockInput& input) {
  if (set.is_concave() != (choice.concave != nullptr)) return Offer::none;
  if (!set.is_concave()) {
    const std::optional<Task> task = record::narrow_task(set.task);
    if (!task || !offers(*choice.entry, *task)) return Offer::none;
    return offers(*choice.entry, set.kind_a, set.kind_b, *task) ? Offer::taken : Offer::unsupported;
  }
  const std::optional<ConcaveTask> task = record::concave_task(set.task);
  if (!task || !offers(*choice.concave, *task, choice.settings.scalar)) return Offer::none;
  if (choice.concave->supports == nullptr) return Offer::taken;
  for (const grade::PairGroup& group : set.frames) {
    for (std::size_t i = 0; i < group.size(); ++i) {
      const ConcaveBody& a = input.bodies[input.shape_of[group.first[i]]];
      const ConcaveBody& b = input.bodies[input.shape_of[group.second[i]]];
      if (!choice.concave->supports(a, b)) return Offer::unsupported;
    }
  }
  return Offer::taken;
}

}  // namespace touchstone::measure
