// The files of advice and of its verification.
#pragma once

#include <filesystem>
#include <string>

#include "harness/record/result_folder.h"
#include "harness/trade/advice/advise.h"
#include "harness/trade/advice/verification.h"

namespace touchstone::trade {

// The question, and the answer in a few lines.
std::string advice_text(const Advice& advice, const AdviceProblem& problem);

// Writes advice.txt and, where there is advice, advice.toml: the best and the next better, as a
// file that `touchstone run` takes.
void write_advice(const Advice& advice, const AdviceProblem& problem,
                  const std::filesystem::path& folder);

// One paragraph.
std::string verification_text(const Verification& verification);

// verification.csv and machine.csv of a folder: a row for each scene, flushed one by one.
class VerificationRows {
 public:
  // `draws`: held-out scenes of each. InputError where the folder cannot be written.
  VerificationRows(const std::filesystem::path& folder, int draws);
  // `verification` is null where there is no advice.
  void write(const AdviceProblem& problem, const Verification* verification);
  void close() { folder_.finish(); }

 private:
  int draws_;
  record::ResultFolder folder_;
};

}  // namespace touchstone::trade
