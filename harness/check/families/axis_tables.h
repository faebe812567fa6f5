// Tables of where algorithms break along the axes of families.
#pragma once

#include <cstddef>
#include <string>

#include "harness/check/check_request.h"
#include "harness/check/families/family_count.h"

namespace touchstone::check {

// For each kind a table with a cell for each contestant and axis: the first value with an answer that is
// missed, false or inexact, or a crash; after a slash the first that it gave up. "-" where there
// is none, empty where it takes no such cases.
std::string axis_tables(const CheckRequest& request, const FamilyCounts& counts,
                        std::size_t page_width);

// The same as sections of a Markdown page; empty without contestants.
std::string axis_sections(const CheckRequest& request, const FamilyCounts& counts);

}  // namespace touchstone::check
