// The context of a search for advice: a request, its scene and its error budget.
// Its verification has the same context.
#pragma once

#include <functional>
#include <string>

#include "harness/trade/advice/error_budget.h"
#include "harness/trade/trade_job.h"

namespace touchstone::trade {

struct AdviceProblem {
  const TradeRequest& request;
  TradeScene& scene;  // the scene of the request
  const Representing& representing;
  const ErrorBudget& budget;
  std::function<void(const std::string&)> said;  // is called with a line for each step
};

}  // namespace touchstone::trade
