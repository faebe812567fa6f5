// Algorithms of all kinds, and regimes and families of cases for them, by their names. Used by the
// command check, and by files of requests.
#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

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

// Returns the narrow phases of these names and groups, to be graded. The oracle belongs to no group: it does not
// grade itself, unless it is named. Throws InputError for a name that is unknown, or that has none
// of the scalars.
std::vector<const NarrowPhaseEntry*> narrow_phases_to_grade(const std::string& names,
                                                            std::span<const Precision> scalars);

// Fills in the algorithms, regimes and families of the request, whose mode and scalars are set. If some kind
// of algorithms is named, only what is named is taken; otherwise all of every kind, or with the mode `count`
// `certified` alone. Without names of regimes and groups all are taken that the algorithms have cases of. Of axes
// `axes` is a list joined by commas, or empty or "all". Throws InputError for a name that there is not, and for
// cases that none of the algorithms takes.
void select_cases(CaseSelection selection, const std::string& axes, CheckRequest& request);

// Takes the pairs of a file in place of regimes and families, as one regime that is called after the file. Of algorithms
// narrow phases alone remain. Throws InputError for what is wrong in the file (files::read_cases), and if no narrow phase
// is left. There is one such file in a program.
void take_case_file(const std::filesystem::path& file, CheckRequest& request);

}  // namespace touchstone::check
