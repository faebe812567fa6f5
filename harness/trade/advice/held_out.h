// Held-out scenes: like the one that a configuration was chosen on, but not used for it.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "harness/trade/advice/error_budget.h"
#include "harness/trade/trade_job.h"

namespace touchstone::trade {

struct HeldOutGrade {
  std::string scene;  // "seed 5", "start 2"
  // a value of the request's measure; NaN if the configuration failed
  double error = Outcome::none;
  std::int64_t near = 0;    // the number of pairs near each other whose truth is known
  std::int64_t missed = 0;  // the number of contacts
  bool within = false;      // true if the error is within the budget
};

class HeldOutScenes {
 public:
  // Makes the draws number `first` to `first + count - 1` of the request's scene; equal numbers are
  // equal scenes. The draw of a generated scene adds its number to the seed. In the draw of any
  // other scene the bodies begin a part of a time step later, which depends on the number, so that
  // each frame lies between two of the scene's frames; bodies at rest stay where they are. There
  // are no draws if nothing moves. Each draw spends about `seconds` on exact answers.
  HeldOutScenes(const TradeRequest& request, const Representing& representing, int first, int count,
                double seconds);

  bool empty() const { return scenes_.empty(); }
  const scene::Scene& scene(std::size_t i) const { return scenes_[i].scene->scene; }
  // A name such as "seeds 4 to 6" or "start 1"; "nothing else: nothing moves" if there are no
  // draws.
  std::string name() const;

  // Returns a grade for each scene.
  std::vector<HeldOutGrade> grade(const Configuration& configuration, const ErrorBudget& budget);

 private:
  struct One {
    std::string name;
    std::unique_ptr<TradeScene> scene;
    std::vector<FrameTruth> truth;
  };
  TradeRequest request_;
  std::string kind_;
  std::vector<One> scenes_;
};

bool all_within(std::span<const HeldOutGrade> grades);

}  // namespace touchstone::trade
