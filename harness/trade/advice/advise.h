// The cheapest configuration that is right enough on a scene, found by measuring.
// Paper:   Jamieson, Talwalkar, "Non-stochastic best arm identification and hyperparameter
//          optimization", AISTATS 2016 (successive halving).
// Departs: errors are found first, on few frames and then on more, and configurations over the
//          budget are dropped; only the others are timed, longer as they get fewer.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/trade/advice/advice_problem.h"
#include "harness/trade/advice/held_out.h"

namespace touchstone::trade {

// Draws of held_out.h that the search itself uses, from 1 on; a verification uses those behind.
inline constexpr int advice_draws = 2;

struct Advice {
  std::optional<TradeOutcome> best;         // none: nothing meets the budget
  std::optional<TradeOutcome> next_better;  // the cheapest with less error; none: no error is left
  std::vector<HeldOutGrade> held_out;       // of the best, on scenes that were not looked at before
  std::string held_out_on;
  std::size_t configurations = 0, within_budget = 0, timed = 0;
  std::int64_t hulls_built = 0;    // in all of the search, for whatever was tried
  double control = Outcome::none;  // time of the A/A control over the baseline's
};

// Without grids in the request: those of default_grids, each kind of bodies represented by itself
// too, but for spheres, which nothing stands for more cheaply; and then what is like the winner but
// for its boxes and broad phase, or its narrow phase. A configuration that is over the budget on a
// held-out scene is dropped for the next.
Advice advise(const AdviceProblem& problem);

}  // namespace touchstone::trade
