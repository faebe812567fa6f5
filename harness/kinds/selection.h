// Selects algorithms by names that the user gives.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "algorithms/registry.h"
#include "harness/base/error.h"
#include "harness/base/group_words.h"
#include "harness/base/nearest_name.h"
#include "harness/modules/file_word.h"

namespace touchstone::kinds {

// Returns the names of a list such as "sap,naive".
inline std::vector<std::string> split_names(std::string_view list) {
  std::vector<std::string> names;
  for (;;) {
    const std::size_t comma = list.find(',');
    names.emplace_back(list.substr(0, comma));
    if (comma == std::string_view::npos) return names;
    list.remove_prefix(comma + 1);
  }
}

// Returns the entries of these names, in the order named, each once. "all" means every one that is
// built; "ours", "libraries" (or "peers"), "oracle" and "modules" mean those of that origin; "none" means none; the file of
// a module that was loaded means those of the module. Throws
// InputError for an unknown name, with the list of known names, for one that is not built, with
// the reason, and for a module without such algorithms. `what` is "broad phase" or "narrow phase".
template <class Entry>
std::vector<const Entry*> select(std::span<const Entry> entries,
                                 const std::vector<std::string>& names, std::string_view what) {
  std::vector<const Entry*> chosen;
  const auto choose = [&](const Entry& entry) {
    if (std::ranges::find(chosen, &entry) == chosen.end()) chosen.push_back(&entry);
  };
  for (const std::string& name : names) {
    if (name == "none") continue;
    std::optional<Origin> origin;
    if (name == "ours") origin = Origin::ours;
    if (name == "libraries" || name == "peers") origin = Origin::peer;
    if (name == "oracle") origin = Origin::oracle;
    if (name == "modules") origin = Origin::module;
    if (name == "all" || origin) {
      for (const Entry& entry : entries) {
        const bool wanted = !origin || entry.info.origin == *origin;
        if (wanted && is_built(entry.info)) choose(entry);
      }
      continue;
    }
    if (modules::is_file(name)) {
      const std::string file = modules::file_of(name);
      const std::size_t before = chosen.size();
      for (const Entry& entry : entries) {
        if (registry::module_of(entry.info) == file) choose(entry);
      }
      if (chosen.size() == before) {
        throw base::InputError(
            fmt::format("{}: has no {}; expected a module with one", name, what));
      }
      continue;
    }
    const auto at =
        std::ranges::find_if(entries, [&](const Entry& entry) { return entry.info.name == name; });
    if (at == entries.end()) {
      std::vector<std::string_view> known(base::group_words.begin(), base::group_words.end());
      for (const Entry& entry : entries) known.push_back(entry.info.name);
      throw base::InputError(base::unknown_name(what, name, known));
    }
    if (!is_built(at->info)) {
      throw base::InputError(
          fmt::format("the {} '{}' is not built, because {}", what, name, at->info.reason));
    }
    choose(*at);
  }
  return chosen;
}

// Returns the list for a message about a wrong request.
inline std::string names_stopping_by_duality_gap() {
  std::string names;
  for (const NarrowPhaseEntry& entry : registry::entries<NarrowPhaseEntry>()) {
    if (entry.traits.stops_by_duality_gap) names += (names.empty() ? "" : ", ") + entry.info.name;
  }
  return names;
}

}  // namespace touchstone::kinds
