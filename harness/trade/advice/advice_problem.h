// What advice is asked for, and held against: a request, its scene, and how right is right enough.
#pragma once

#include <functional>
#include <string>

#include "harness/trade/advice/error_budget.h"
#include "harness/trade/trade_job.h"

namespace touchstone {

struct AdviceProblem {
  const TradeRequest& request;
  TradeScene& scene;  // the request's
  const Representing& representing;
  const ErrorBudget& budget;
  std::function<void(const std::string&)> said;  // is told what comes of it on the way
};

}  // namespace touchstone
