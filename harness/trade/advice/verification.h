// A test of advice: its choice against the whole grid, and on held-out scenes.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "harness/stats/statistics.h"
#include "harness/trade/advice/budget.h"

namespace touchstone::trade {

inline constexpr double allowed_ratio = 1.1;  // the choice's time over that of the grid's best

enum class TimeVerdict : std::uint8_t {
  within,     // the whole interval of the ratio is at most allowed_ratio
  beyond,     // the whole interval is above allowed_ratio
  undecided,  // the interval contains allowed_ratio, or there is none
};
std::string_view to_string(TimeVerdict verdict);
TimeVerdict time_verdict(const stats::MedianInterval& ratio);

struct Verification {
  TradeOutcome choice;         // its errors are those on all frames that the grid is graded on
  bool within_budget = false;  // true if it is within the budget there and on every held-out scene
  std::string held_out_on;
  std::vector<HeldOutGrade> held_out;  // grades of the choice
  std::size_t configurations = 0;
  std::size_t rivals = 0;  // the number of others within the budget
  // the number of rivals that are over the budget on a held-out scene, among those graded
  std::size_t dropped = 0;
  // The fastest other configuration that is within the budget everywhere; empty if there is none.
  std::string best;
  // Seconds a frame, from the same rounds.
  double seconds = Outcome::none, best_seconds = Outcome::none;
  stats::MedianInterval ratio{Outcome::none, Outcome::none, Outcome::none,
                              0};  // the ratio of these two times
  TimeVerdict time = TimeVerdict::within;

  bool holds() const { return within_budget && time == TimeVerdict::within; }
};

// Measures the request's grids into that folder, as `touchstone advise --front` does; without grids it takes
// those of default_grids and also represents each kind of bodies by itself. Then it times the
// choice interleaved with the fastest configurations within the budget, for longer if the interval
// does not decide. The held-out scenes are `draws` of budget.h from `first_draw` on, for the
// choice and its rivals. It takes about twice the request's seconds.
Verification verify(const AdviceProblem& problem, const Configuration& choice, int first_draw,
                    int draws, const std::filesystem::path& folder);

}  // namespace touchstone::trade
