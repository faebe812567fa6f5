// The modules of `touchstone run --with`, in a campaign.
#pragma once

#include <string>
#include <vector>

#include "harness/campaign/campaign.h"

namespace touchstone::commands {

// Adds the algorithms of these modules, files joined by commas that are loaded, to every group: of each kind that the
// group asks, in the scalars that it asks. Throws InputError for one of which no group asks anything.
void add_modules(const std::string& words, campaign::Campaign& campaign);

// Adds the names of modules' algorithms that the campaign measures.
void add_measured_modules(const campaign::Campaign& campaign, std::vector<std::string>& names);

}  // namespace touchstone::commands
