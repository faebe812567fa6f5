// Decides whether two results are comparable, and lists what differs between them.
#pragma once

#include <string>
#include <vector>

#include "harness/stats/samples.h"

namespace touchstone::stats {

// The names of the two results in messages.
struct ResultNames {
  std::string a = "A", b = "B";
};

// Cells of A that B lacks, each a line for the user.
struct Missing {
  std::vector<std::string> scenes;  // the same scene has another hash in B
  std::vector<std::string> cells;   // B did not run it
};
Missing missing(const Results& a, const Results& b, const ResultNames& names = {});

// Returns the reasons against a comparison of times, each a line; none if A and B are comparable.
// `machines`: the machines must be equal too.
std::vector<std::string> obstacles(const Results& a, const Results& b, bool machines);

// Differences that may explain a difference in time: compiler, flags, library versions, commit,
// algorithms that only B has.
std::vector<std::string> remarks(const Results& a, const Results& b);

}  // namespace touchstone::stats
