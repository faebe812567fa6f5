// What advice and its verification leave behind; described in results/README.md.
#pragma once

#include <filesystem>
#include <string>

#include "harness/files/csv.h"
#include "harness/trade/advice/advise.h"
#include "harness/trade/advice/verification.h"

namespace touchstone {

// What was asked, and what is told of the answer.
std::string advice_text(const Advice& advice, const TradeRequest& request,
                        const ErrorBudget& budget, const TradeScene& scene);

// advice.txt and, where there is advice, advice.toml: the best and the next better, as a file that
// `touchstone run` takes.
void write_advice(const Advice& advice, TradeRequest request, const ErrorBudget& budget,
                  const TradeScene& scene, const std::filesystem::path& folder);

// One paragraph.
std::string verification_text(const Verification& verification);

// verification.csv: a row for each scene, flushed one by one.
class VerificationRows {
 public:
  // `draws`: held-out scenes of each. InputError where the file cannot be written.
  VerificationRows(const std::filesystem::path& file, int draws);
  // Null: there is no advice.
  void write(const TradeRequest& request, const ErrorBudget& budget, const TradeScene& scene,
             const Verification* verification);
  void close() { file_.close(); }

 private:
  int draws_;
  CsvWriter file_;
};

}  // namespace touchstone
