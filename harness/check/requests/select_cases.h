// Algorithms of all kinds, and regimes and families of cases for them, by their names. Used by the
// command check, and by files of requests.
#pragma once

#include <map>
#include <string>

#include "harness/check/axes/stress_request.h"
#include "harness/check/check_request.h"
#include "harness/kinds/kind.h"

namespace touchstone::check {

// What a user names, each a list joined by commas. Empty: nothing was said.
struct CaseSelection {
  std::string with;   // algorithms of all kinds, or of those in `kinds`
  std::string kinds;  // names of kinds: pair, box, and those of kinds::kinds()
  // Algorithms of one kind.
  std::string pair, box;
  std::map<const kinds::Kind*, std::string> others;
  std::string regimes, groups;  // of regimes and families

  bool is_unsaid() const;  // no algorithms and no kind is named
};

// Fills in the algorithms, regimes and families of the request, whose scalars are set. If some kind
// of algorithms is named, only what is named is taken; otherwise `fallback` of every kind. Without
// names of regimes and groups all are taken that the algorithms have cases of. Throws InputError for
// a name that there is not, and for cases that none of the algorithms takes.
void select_cases(const CaseSelection& selection, const char* fallback, CheckRequest& request);

// Fills in the algorithms and axes of a sweep in the same way: `axes` is a list joined by commas, or
// empty or "all" for all that the algorithms have cases of.
void select_axes_and_algorithms(const CaseSelection& selection, const std::string& axes,
                                StressRequest& request);

}  // namespace touchstone::check
