// Case files of wrong answers to the cases of families.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/check/check_request.h"
#include "harness/check/families/family_count.h"

namespace touchstone::check {

struct FamilyFailure {
  FamilyCount count;
  std::string command;  // asks for the first such case again
};

// Writes the first case of each count that has missed, false, inexact or failed ones, into failures/ of
// the request's folder: all of ours, and one of a family for each other contestant.
std::vector<FamilyFailure> write_family_failures(const CheckRequest& request,
                                                 const FamilyCounts& counts);

// Returns those that break a promise of ours, one line each.
std::vector<std::string> broken_family_promises(const CheckRequest& request,
                                                const std::vector<FamilyFailure>& failures);

}  // namespace touchstone::check
