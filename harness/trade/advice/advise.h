// The cheapest configuration that is right enough on a scene, found by measuring.
// Paper:   Jamieson, Talwalkar, "Non-stochastic best arm identification and hyperparameter
//          optimization", AISTATS 2016 (successive halving).
// Departs: errors are found first, on few frames and then on more, and configurations over the
//          budget are dropped; only the others are timed, longer as they get fewer.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/trade/advice/budget.h"

namespace touchstone::trade {

// The least number of draws of budget.h that the search itself uses, from 1 on; a verification uses those from
// verification_draw on.
inline constexpr int advice_draws = 2, verification_draw = 1001;

struct Advice {
  std::optional<TradeOutcome> best;  // empty if nothing is known to meet the budget
  // Where there is no best: the cheapest that no test was against, and no test was for.
  std::optional<TradeOutcome> untested;
  // The cheapest configuration with less error; empty if there is no error left.
  std::optional<TradeOutcome> next_better;
  // The cheapest that no test was against, with a library among its algorithms, or, if the best has one, without.
  std::optional<TradeOutcome> rival;
  // Grades of the best on scenes that the search did not look at, and what they show; without such scenes what the
  // scene itself shows. Where there is no best, of the untested.
  std::vector<HeldOutGrade> held_out;
  std::string held_out_on;
  std::vector<Evidence> evidence;
  std::size_t configurations = 0, within_budget = 0, timed = 0;
  std::size_t with_library = 0;                // of the configurations
  double least_library_error = Outcome::none;  // of these
  std::int64_t hulls_built = 0;                // the number built in the whole search
  double control = Outcome::none;  // the time of the A/A control over that of the baseline
};

// Returns whether an algorithm of the configuration is a library's.
bool uses_library(const Configuration& configuration);

// If the request has no grids, the search takes those of default_grids, and also represents each
// kind of bodies by itself, except spheres, which have no cheaper representation. Then it tries the
// configurations that differ from the winner only in boxes and broad phase, or only in the narrow
// phase. Held-out scenes are drawn until they show that the cheapest meets the budget, or the time is out. One that is
// over the budget there is replaced by the next.
Advice advise(const AdviceProblem& problem);

}  // namespace touchstone::trade
