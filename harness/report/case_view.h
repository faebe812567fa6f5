// Pairs of bodies with what is true of them and what every algorithm says.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/files/cases.h"
#include "harness/files/concave_cases.h"
#include "harness/files/json_line.h"

namespace touchstone::report {

struct ListedCase {
  files::Case c;
  std::string file;          // relative to the results folder
  std::string about;         // why the file lists it; the file's name if it does not say
  std::string command = {};  // that asks about it again; empty: by its id in the file
};

// Reads the cases of a file in the results folder.
std::vector<ListedCase> listed_cases(const std::filesystem::path& folder, const std::string& file);

// Asks every narrow phase that takes a pair, in a child process, whether its bodies are in contact,
// and for their distance or depth; a query may take `time_limit` seconds. The truth and its proof
// are the oracle's.
files::OrderedJson case_views(const std::vector<ListedCase>& cases,
                              const std::filesystem::path& folder, double time_limit);

// A pair of any bodies that somebody asks about.
struct AskedPair {
  files::ConcaveCase c;
  std::string source;   // the file's name
  std::string command;  // that asks about it again
};

// The same for these, in their order. Pairs with a body that is not convex go to concave phases, and answers about them
// are compared by their side of contact alone.
files::OrderedJson pair_views(const std::vector<AskedPair>& pairs, double time_limit);

}  // namespace touchstone::report
