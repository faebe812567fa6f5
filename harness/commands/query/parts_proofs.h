// Certificates of touchstone query, for bodies of both kinds.
#pragma once

#include <string>
#include <vector>

#include "algorithms/concave_phase.h"
#include "harness/files/concave/concave_cases.h"

namespace touchstone::commands {

// Proves the exact answer of each case, writes one certificate a line, and prints how many, and which cases have none
// because that took more than so many seconds. Throws InputError if the file cannot be written.
void save_parts_proofs(const std::string& file, ConcaveTask task,
                       const std::vector<files::ConcaveCase>& cases, double seconds);

// Returns the program's exit status; prints what is refused and why. If there is a file of cases, each certificate has
// to be of one of them.
int verify_parts_proofs(const std::string& file, const std::string& cases);

}  // namespace touchstone::commands
