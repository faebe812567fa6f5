// Regimes by their names and groups.
#include "harness/check/regimes/select_regimes.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "harness/base/error.h"
#include "harness/campaign/selection.h"

namespace touchstone::check {

std::vector<const Regime*> select_regimes(const std::string& names, const std::string& groups) {
  std::vector<std::string> wanted, wanted_groups;
  if (!names.empty()) wanted = campaign::split_names(names);
  if (!groups.empty()) wanted_groups = campaign::split_names(groups);
  const auto expect = [](std::string_view what, const std::vector<std::string>& asked,
                         std::string Regime::*field) {
    for (const std::string& name : asked) {
      std::string known;
      bool found = false;
      for (const Regime& regime : regimes()) {
        const std::string& own = regime.*field;
        found = found || own == name;
        if (known.find(own + ",") == std::string::npos) known += own + ", ";
      }
      if (found) continue;
      throw base::InputError(fmt::format("no {} is called '{}'; expected some of {}", what, name,
                                         known.substr(0, known.size() - 2)));
    }
  };
  expect("regime", wanted, &Regime::name);
  expect("group of regimes", wanted_groups, &Regime::group);
  std::vector<const Regime*> chosen;
  const bool all = wanted.empty() && wanted_groups.empty();
  for (const Regime& regime : regimes()) {
    if (all || std::ranges::find(wanted, regime.name) != wanted.end() ||
        std::ranges::find(wanted_groups, regime.group) != wanted_groups.end()) {
      chosen.push_back(&regime);
    }
  }
  return chosen;
}

}  // namespace touchstone::check
