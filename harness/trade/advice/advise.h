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

// The number of draws of held_out.h that the search itself uses, from 1 on; a verification uses
// those behind.
inline constexpr int advice_draws = 2;

struct Advice {
  std::optional<TradeOutcome> best;  // empty if nothing meets the budget
  // The cheapest configuration with less error; empty if there is no error left.
  std::optional<TradeOutcome> next_better;
  // Grades of the best on scenes that the search did not look at.
  std::vector<HeldOutGrade> held_out;
  std::string held_out_on;
  std::size_t configurations = 0, within_budget = 0, timed = 0;
  std::int64_t hulls_built = 0;    // the number built in the whole search
  double control = Outcome::none;  // the time of the A/A control over that of the baseline
};

// If the request has no grids, the search takes those of default_grids, and also represents each
// kind of bodies by itself, except spheres, which have no cheaper representation. Then it tries the
// configurations that differ from the winner only in boxes and broad phase, or only in the narrow
// phase. A configuration that is over the budget on a held-out scene is replaced by the next.
Advice advise(const AdviceProblem& problem);

}  // namespace touchstone::trade
