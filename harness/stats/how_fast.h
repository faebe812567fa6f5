// The part of a summary that compares ours with libraries: by scene, by question, and for the user's own algorithms.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "harness/stats/summary.h"

namespace touchstone::stats {

// What is not to be trusted.
struct Doubts {
  std::size_t inputs = 0, few_squares = 0, none_of_ours = 0;
  std::vector<std::string> suspect;
};

struct FastText {
  std::string text;  // empty if nothing was timed
  Doubts doubts;
};

FastText how_fast(const Results& results, const Tables& tables, const ReportSetting& setting);

// Returns the line NOT TRUSTED; empty if there is no doubt.
std::string doubts_text(const Doubts& doubts);

}  // namespace touchstone::stats
