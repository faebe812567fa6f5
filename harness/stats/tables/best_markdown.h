// Markdown of the best of ours against the best of others; the text is empty if there are none.
#pragma once

#include <string>
#include <vector>

#include "harness/stats/tables/tables.h"

namespace touchstone::stats {

std::string broad_best_table(const std::vector<BroadBestRow>& rows);
std::string narrow_best_table(const std::vector<NarrowBestRow>& rows, double depth_error);

}  // namespace touchstone::stats
