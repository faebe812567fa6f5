// Algorithms of all kinds, and families of cases for them, by their names. Used by the
// command check, and by files of requests.
#pragma once

#include <map>
#include <string>

#include "harness/check/family_checker.h"

namespace touchstone::check {

// What a user names, each a list joined by commas. Empty: nothing was said.
struct CaseSelection {
  std::string with;   // algorithms of all kinds, or of those in `kinds`
  std::string kinds;  // names of kinds::checked_kinds()
  std::map<const kinds::Kind*, std::string> of_one;  // algorithms of one kind
  std::string regimes, groups;                       // names and groups of families

  bool is_unsaid() const;  // no algorithms and no kind is named
};

// Fills in the algorithms and families of the request, whose mode and scalars are set. If some kind
// of algorithms is named, only what is named is taken; otherwise all of every kind, or with the mode `count`
// what the kinds count alone. Without names and groups all families are taken that the algorithms have cases of. Of
// axes `axes` is a list joined by commas, or empty or "all". Throws InputError for a name that there is not, and for
// cases that none of the algorithms takes.
void select_cases(const CaseSelection& selection, const std::string& axes, CheckRequest& request);

}  // namespace touchstone::check
