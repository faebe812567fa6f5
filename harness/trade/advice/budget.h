// The error that a configuration may have, and what tests of one show: on scenes like the one that it was chosen on,
// but not used for it.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "harness/trade/trade_job.h"

namespace touchstone::trade {

struct ErrorBudget {
  double most = 1e-3;  // a value of the request's measure
  // if true, every contact is found and every contact has an answer
  bool no_false_negatives = false;

  // True if nothing may stand for a body that can miss a contact.
  bool needs_every_contact() const { return no_false_negatives || most == 0; }
};

// A text such as "verdicts at most 0.001, no contact missed".
std::string to_string(const ErrorBudget& budget, ErrorMeasure measure);

// Returns whether these errors are allowed, as they were counted: they say nothing of other pairs.
bool meets(const ErrorBudget& budget, ErrorMeasure measure, const Evaluation& evaluation,
           const RepresentationSpread& representation);

// Returns whether something stands for a body that does not contain it, so that contacts may be missed.
bool can_miss(const Representations& representations);
// Returns whether the budget lets these stand for the bodies, whatever tests show.
inline bool may_stand(const ErrorBudget& budget, const Representations& representations) {
  return !budget.needs_every_contact() || !can_miss(representations);
}

// The context of a search for advice: a request, its scene and its error budget. Its verification has the same context.
struct AdviceProblem {
  const TradeRequest& request;
  TradeScene& scene;  // the scene of the request
  const Representing& representing;
  const ErrorBudget& budget;
  std::function<void(const std::string&)> said;  // is called with a line for each step
};

// The greatest share of all that is wrong, at 95 %, if `wrong` of `of` that were drawn are (Clopper and Pearson 1934);
// 1 if nothing was drawn.
double greatest_share(std::int64_t wrong, std::int64_t of);

// What tests show: how many went wrong, of how many, and the share of all that may be wrong.
struct Evidence {
  std::int64_t wrong = 0, of = 0;
  double allowed = 1;               // of all
  std::string_view what = "pairs";  // or contacts, or numbers: distances and depths

  double share() const {
    return of == 0 ? 0 : static_cast<double>(wrong) / static_cast<double>(of);
  }
  double upper() const { return greatest_share(wrong, of); }
  bool holds() const { return upper() <= allowed; }
};

// The evidence for the whole budget, each part of which has to hold. A share is held against the budget; that of a
// budget of zero, which no test reaches, and of contacts, none of which may be missed, against `zero_is_below`. Of
// distances and depths the greatest error has to hold for 95 % of all, the 99th percentile for 99 %. Volumes and
// surfaces are measured, and need no evidence.
inline constexpr double zero_is_below = 1e-3;
std::vector<Evidence> evidence_for(const ErrorBudget& budget, ErrorMeasure measure,
                                   const PointErrors& errors);

// Why the evidence is not enough, such as "1 pair tests nothing: move the bodies, or give more frames"; empty if it is.
std::string lack_of(std::span<const Evidence> evidence, bool is_drawn);

struct HeldOutGrade {
  std::string scene;  // "seed 5", "start 2"
  // a value of the request's measure; NaN if the configuration failed
  double error = Outcome::none;
  bool within = false;  // true if the error is within the budget
  PointErrors errors = {};
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

  // Draws up to so many more in about so many seconds, one at least. Returns false if there are no draws, or as many as
  // fit in memory.
  bool draw(int count, double seconds);

  bool empty() const { return scenes_.empty(); }
  std::size_t size() const { return scenes_.size(); }
  const scene::Scene& scene(std::size_t i) const { return scenes_[i].scene->scene; }
  // A name such as "seeds 4 to 6" or "start 1"; "nothing else: nothing moves" if there are no
  // draws.
  std::string name() const;

  // Returns a grade for each scene from this one on.
  std::vector<HeldOutGrade> grade(const Configuration& configuration, const ErrorBudget& budget,
                                  std::size_t from = 0);

 private:
  struct One {
    std::string name;
    std::unique_ptr<TradeScene> scene;
    std::vector<FrameTruth> truth;
  };
  bool draw_one(double seconds);

  TradeRequest request_;
  const Representing& representing_;
  std::int64_t seed_;
  int next_;
  std::string kind_;
  std::vector<One> scenes_;
};

// Returns whether a configuration may stand for the scene and its counted errors are allowed.
bool within(const AdviceProblem& problem, const TradeOutcome& outcome);
bool all_within(std::span<const HeldOutGrade> grades);
// Sums counts; of numbers it has the greatest spread.
PointErrors sum_of(std::span<const HeldOutGrade> grades);

}  // namespace touchstone::trade
