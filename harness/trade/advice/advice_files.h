// The files of advice and of its verification.
#pragma once

#include <filesystem>
#include <string>

#include "harness/record/result_folder.h"
#include "harness/trade/advice/advise.h"
#include "harness/trade/advice/verification.h"

namespace touchstone::trade {

// Returns the question, and the answer in a few lines.
std::string advice_text(const Advice& advice, const AdviceProblem& problem);

// Writes advice.txt and, if there is advice, advice.toml: the best configuration and the next
// better one, as a file that `touchstone run` takes.
void write_advice(const Advice& advice, const AdviceProblem& problem,
                  const std::filesystem::path& folder);

// Returns one paragraph.
std::string verification_text(const Verification& verification);

// Writes verification.csv and machine.csv of a folder: a row for each scene, flushed one by one.
class VerificationRows {
 public:
  // `draws` is the number of held-out scenes of each. Throws InputError if the folder cannot be
  // written.
  VerificationRows(const std::filesystem::path& folder, int draws);
  // `verification` is null if there is no advice.
  void write(const AdviceProblem& problem, const Verification* verification);
  void close() { folder_.finish(); }

 private:
  int draws_;
  record::ResultFolder folder_;
};

}  // namespace touchstone::trade
