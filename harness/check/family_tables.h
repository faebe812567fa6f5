// Tables of what algorithms answer to the cases of families.
#pragma once

#include <cstddef>
#include <string>

#include "harness/check/check_report.h"

namespace touchstone::check {

// A table of each kind for the terminal, with a row for each contestant; empty if there is none.
std::string family_summary(const CheckReport& report, std::size_t page_width);

// Sections of the Markdown page, one of each kind: the sums, and who is wrong in which family.
std::string family_sections(const CheckReport& report);

// For each kind a table with a cell for each contestant and axis: the first value with an answer that is
// missed, false or inexact, or a crash; after a slash the first that it gave up. "-" where there
// is none, empty where it takes no such cases.
std::string axis_tables(const CheckReport& report, std::size_t page_width);

// The same as sections of a Markdown page; empty without contestants.
std::string axis_sections(const CheckReport& report);

}  // namespace touchstone::check
