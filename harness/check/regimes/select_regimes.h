// Regimes by their names and groups. Used by the commands check and soak.
#pragma once

#include <string>
#include <vector>

#include "harness/check/regimes/regimes.h"

namespace touchstone::check {

// Returns the regimes of these names and of these groups, each joined by commas, or all if both are
// empty. Throws base::InputError for a name that there is not.
std::vector<const Regime*> select_regimes(const std::string& names, const std::string& groups);

}  // namespace touchstone::check
