// A file of scenes, each with the error that is allowed: the input of `touchstone advise --list`.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/trade/advice/error_budget.h"
#include "harness/trade/trade_request.h"

namespace touchstone::trade {

struct AdviceTask {
  // The name of the folder: the scene file's stem, unless the list gives another.
  std::string name;
  TradeRequest request;
  ErrorBudget budget;
};

// The keys are documented in datasets/README.md; a key that is missing has its value from `usual`.
// Throws InputError with file, line and what was expected; names are distinct.
std::vector<AdviceTask> read_advice_list(const std::filesystem::path& file,
                                         const TradeRequest& usual);

}  // namespace touchstone::trade
