// The files of advice and of its verification, and the list of scenes of `touchstone advise --list`.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/record/result_folder.h"
#include "harness/record/row.h"
#include "harness/trade/advice/advise.h"
#include "harness/trade/advice/verification.h"
#include "harness/trade/trade_files.h"

namespace touchstone::trade {

struct AdviceTask {
  // The name of the folder: the scene file's stem, unless the list gives another.
  std::string name;
  TradeRequest request;
  ErrorBudget budget;
};

// Reads scenes, each with the error that is allowed. The keys are documented in datasets/README.md; a key that is
// missing has its value from `usual`. Throws InputError with file, line and what was expected; names are distinct.
std::vector<AdviceTask> read_advice_list(const std::filesystem::path& file,
                                         const TradeRequest& usual);

// advice.csv: one configuration that the advice names.
struct AdviceRow {
  std::string role;
  std::string point;
  ConfigurationNames configuration;
  double seconds = Outcome::none, low = Outcome::none, high = Outcome::none, ratio = Outcome::none;
  double error = Outcome::none;
  ErrorMeasure measure = ErrorMeasure::verdicts;
  std::optional<std::int64_t> wrong, of;
  double upper = Outcome::none;
};
template <record::row_of<AdviceRow> Row, class Visit>
void columns(Row& row, Visit visit) {
  visit("role", row.role,
        "`cheapest`; `next better`, of those with less error; `library` or `ours`: the cheapest "
        "with a library among "
        "its algorithms, or without; `untested`: what no test was against, nor enough for.");
  visit("point", row.point, "Name of the configuration.");
  columns(row.configuration, visit);
  visit("seconds", row.seconds, "Time of a frame, seconds: the median.");
  visit("seconds_low", row.low, "Lower end of its 95 % interval.");
  visit("seconds_high", row.high, "Upper end of its 95 % interval.");
  visit("ratio", row.ratio, "Its time over that of the cheapest, from the same rounds.");
  visit("error", row.error, "Error on the scene by `error_measure`.");
  visit("error_measure", row.measure, "The measure that was asked for.");
  visit("wrong", row.wrong,
        "Of the first row: what went wrong on scenes that the search did not look at.");
  visit("tested", row.of, "Of how many pairs, contacts or numbers.");
  visit("wrong_at_most", row.upper, "The greatest share of all that may be wrong, at 95 %.");
}

// Returns the question, and the answer in a few lines.
std::string advice_text(const Advice& advice, const AdviceProblem& problem);

// Writes advice.txt, advice.csv with a row for each configuration that the text names and, if there is advice,
// advice.toml: the best configuration and the next better one, as a file that `touchstone run` takes.
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
