// A test of advice: its choice against the whole grid, and on scenes that it was not made on.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "harness/stats/statistics.h"
#include "harness/trade/advice/advice_problem.h"
#include "harness/trade/advice/held_out.h"

namespace touchstone::trade {

inline constexpr double allowed_ratio = 1.1;  // of the choice's time to that of the grid's best

enum class TimeVerdict : std::uint8_t {
  within,     // the whole interval of the ratio is at most allowed_ratio
  beyond,     // it is above
  undecided,  // neither, or there is no interval
};
std::string_view to_string(TimeVerdict verdict);
TimeVerdict time_verdict(const stats::MedianInterval& ratio);

struct Verification {
  TradeOutcome choice;         // with its errors on all frames that the grid is graded on
  bool within_budget = false;  // there, and on every held-out scene
  std::string held_out_on;
  std::vector<HeldOutGrade> held_out;  // of the choice
  std::size_t configurations = 0;
  std::size_t rivals = 0;   // others within the budget
  std::size_t dropped = 0;  // of these, over it on a held-out scene, as far as they were looked at
  // The fastest other that is within the budget everywhere; empty: there is none.
  std::string best;
  double seconds = Outcome::none, best_seconds = Outcome::none;  // a frame, in the same rounds
  stats::MedianInterval ratio{Outcome::none, Outcome::none, Outcome::none,
                              0};  // of these two times
  TimeVerdict time = TimeVerdict::within;

  bool holds() const { return within_budget && time == TimeVerdict::within; }
};

// Measures the request's grids, or without any those of default_grids with each kind of bodies
// represented by itself too, as `touchstone trade` does and into that folder; then the choice
// interleaved with the fastest that are within the budget, for longer where the interval does not
// tell. Held-out scenes: `draws` of held_out.h from `first_draw` on, with the choice and those.
// Takes about twice the request's seconds.
Verification verify(const AdviceProblem& problem, const Configuration& choice, int first_draw,
                    int draws, const std::filesystem::path& folder);

}  // namespace touchstone::trade
