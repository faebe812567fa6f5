// Tables of what algorithms answer to the cases of families.
#pragma once

#include <cstddef>
#include <string>

#include "harness/check/check_request.h"
#include "harness/check/families/family_count.h"

namespace touchstone::check {

// A table of each kind for the terminal, with a row for each contestant; empty if there is none.
std::string family_summary(const CheckRequest& request, const FamilyCounts& counts,
                           std::size_t page_width);

// Sections of the Markdown page, one of each kind: the sums, and who is wrong in which family.
std::string family_sections(const CheckRequest& request, const FamilyCounts& counts);

}  // namespace touchstone::check
