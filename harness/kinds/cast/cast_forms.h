// Forms of cases of moving bodies: swapped, scaled, moved, reversed and cut in two.
#pragma once

#include <vector>

#include "harness/files/cases.h"
#include "harness/kinds/batch.h"
#include "harness/kinds/exact_forms.h"

namespace touchstone::kinds {

// One case, or the two halves of one.
using CastParts = std::vector<files::CastCase>;

// Returns the case in that form; nothing if the form would round a number. Bodies that turn are an exception:
// where they are at another time is always rounded.
CastParts parts_in_form(const files::CastCase& c, const FormNumbers& numbers, CaseForm form);

// True if the form rounds where bodies are, so that where rounding decides it has another exact answer.
bool rounds(const files::CastCase& c, CaseForm form);

}  // namespace touchstone::kinds
