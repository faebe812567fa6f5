// Case files of what an algorithm answered wrongly.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/check/tally.h"

namespace touchstone {

struct FailureCase {
  GradedAnswer answer;  // of the case as it is in the file
  std::string id;       // of the case that it was shrunk from
  std::string what;     // is wrong with the answer, in words
  std::filesystem::path file;

  // That shows it again.
  std::string command(const CheckRequest& request) const;
};

// What is wrong with an answer, in words.
std::string describe(const GradedAnswer& answer, const CheckRequest& request);

// Writes Tally::failures, each shrunk as far as it still fails in the same way, into the request's
// folder: failures/ALGORITHM-SCALAR-TASK.jsonl, one case a line. Case files of an earlier check
// there are removed.
std::vector<FailureCase> write_failures(const CheckRequest& request, const Tally& tally);

}  // namespace touchstone
