// The cheapest configuration that is right enough on a scene, found by measuring.
// Paper:   Jamieson, Talwalkar, "Non-stochastic best arm identification and hyperparameter
//          optimization", AISTATS 2016 (successive halving).
// Departs: errors are looked at first, on few frames and then on more, and who is over the budget
//          is out; only the others are timed, longer as they get fewer.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "harness/trade/trade_job.h"

namespace touchstone {

struct ErrorBudget {
  double most = 1e-3;               // of the request's measure
  bool no_false_negatives = false;  // no contact missed, and none left without an answer
};
bool meets(const ErrorBudget& budget, ErrorMeasure measure, const Evaluation& evaluation,
           const RepresentationSpread& representation);

struct Advice {
  std::optional<TradeOutcome> best;         // none: nothing meets the budget
  std::optional<TradeOutcome> next_better;  // the cheapest with less error; none: no error is left
  // On frames, or seeds of a generated scene, that were not looked at before.
  Evaluation held_out;
  std::string held_out_on;
  std::size_t configurations = 0, within_budget = 0, timed = 0;
  double twin = Outcome::none;
};

// Fills in the grids where the request has none. A configuration that is over the budget where it
// was not looked at before is dropped for the next.
Advice advise(TradeRequest& request, TradeScene& scene, const Representing& representing,
              const ErrorBudget& budget, const std::function<void(const std::string&)>& said);

}  // namespace touchstone
