// Pairs with the answers that were recorded about them, such as those of a library's versions that are not installed
// where the page is made.
#pragma once

#include <filesystem>

#include "harness/files/json_line.h"

namespace touchstone::report {

// The pairs of the folder's wrong_pairs.jsonl, which `check` writes where it compares versions, and which zstd may have
// packed; none if it is not there. Each is a case view, whose key `recorded` has the group, the answers, and tests of the algorithms that have such
// a form. Throws InputError with file, line and key for what is wrong in the file.
files::OrderedJson recorded_pair_views(const std::filesystem::path& folder, double time_limit);

}  // namespace touchstone::report
