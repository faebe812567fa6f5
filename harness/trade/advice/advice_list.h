// A file of scenes, each with the error that will do: what `touchstone advise --list` works off.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/trade/advice/error_budget.h"
#include "harness/trade/trade_request.h"

namespace touchstone::trade {

struct AdviceTask {
  std::string name;  // of its folder: the scene file's stem, unless the list says otherwise
  TradeRequest request;
  ErrorBudget budget;
};

// The keys are documented in datasets/README.md; what they do not say is as in `usual`. Throws
// InputError with file, line and what was expected; names are distinct.
std::vector<AdviceTask> read_advice_list(const std::filesystem::path& file,
                                         const TradeRequest& usual);

}  // namespace touchstone::trade
