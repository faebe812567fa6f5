// Narrow phases by their names.
#include "harness/check/requests/select_narrow.h"

#include <fmt/format.h>

#include <algorithm>

#include "harness/base/error.h"
#include "harness/kinds/selection.h"

namespace touchstone::check {

std::vector<const NarrowPhaseEntry*> narrow_phases_to_grade(const std::string& names,
                                                            std::span<const Precision> scalars) {
  const std::vector<std::string> list = kinds::split_names(names);
  const auto is_named = [&](const NarrowPhaseEntry* entry) {
    return std::ranges::find(list, entry->info.name) != list.end();
  };
  auto chosen = kinds::select(registry::entries<NarrowPhaseEntry>(), list, "narrow phase");
  std::erase_if(chosen, [&](const NarrowPhaseEntry* entry) {
    return entry->info.origin == Origin::oracle && !is_named(entry);
  });
  for (const NarrowPhaseEntry* entry : chosen) {
    // An algorithm of a group may lack the scalar: it is left out.
    const bool offered =
        std::ranges::any_of(scalars, [&](Precision scalar) { return offers(*entry, scalar); });
    if (!is_named(entry) || offered) continue;
    throw base::InputError(fmt::format("'{}' does not compute in {}; expected another --scalar",
                                       entry->info.name, to_string(scalars.front())));
  }
  return chosen;
}

}  // namespace touchstone::check
