// The options that select algorithms of many kinds and cases for them. Used by check, stress and soak.
#pragma once

#include "harness/check/requests/select_cases.h"
#include "harness/commands/arguments.h"

namespace touchstone::commands {

// Adds --with and --kind, and an option for each kind by its old name.
void add_kinds(Arguments& command, check::CaseSelection& selection);
// Adds these, --regimes and --groups.
void add_selection(Arguments& command, check::CaseSelection& selection);

}  // namespace touchstone::commands
