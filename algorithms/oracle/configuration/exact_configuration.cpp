// Exact configurations: every pair of parts that is asked, one after the other, by the answers that it is given.
// Paper:   README.md states the problem of two convex bodies; concave/exact_concave.cpp that of others.
// Steps:   1. Place both parts of a pair, as the contract says.
//          2. Ask about them, without bounds, whatever the pairs before said.
//          3. free: the first pair in contact ends it; distance: the least of all.
// Departs: -
// Fails:   as the answers that it is given: exact ones where it is asked as the oracle.
// Cost:    that of all pairs.
#include <limits>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

#include "algorithms/configuration_query.h"

namespace touchstone {
namespace {

class ExactConfigurations final : public ConfigurationQuery {
 public:
  explicit ExactConfigurations(const ConfigurationSettings& settings)
      : phase_(settings.concave_phase()) {}

  void bind(const ConfigurationModel& model) override {
    model_ = &model;
    bodies_.clear();
    for (const ModelPart& part : model.parts) bodies_.push_back(part.body);
    phase_->bind(bodies_);
  }

  void solve(ConfigurationTask task, const Configurations& configurations,
             std::span<ConfigurationAnswer> answers) override {
    answer_steps(task, configurations, answers,
                 [&](std::span<const Pose> links) { return answer(task, links); });
  }

 private:
  ConfigurationAnswer answer(ConfigurationTask task, std::span<const Pose> links) {
    ConfigurationAnswer found;
    found.answer = Answer::separated;
    found.status = Status::ok;
    const bool measures = task == ConfigurationTask::distance;
    if (measures) found.distance = std::numeric_limits<double>::infinity();
    for (const IndexPair& pair : model_->pairs) {
      Outcome outcome;
      phase_->solve(measures ? ConcaveTask::distance : ConcaveTask::intersect,
                    {pair.a, placed(model_->parts[pair.a], links)},
                    {pair.b, placed(model_->parts[pair.b], links)}, outcome, touching_);
      if (outcome.answer == Answer::touching || outcome.answer == Answer::overlapping) {
        return {.answer = Answer::overlapping,
                .status = Status::ok,
                .pair = pair,
                .distance = measures ? 0 : Outcome::none};
      }
      if (outcome.answer == Answer::unknown) {
        found.answer = Answer::unknown;
        found.status = outcome.status;
      } else if (measures && outcome.distance < found.distance) {
        found.distance = outcome.distance;
        found.pair = pair;
      }
    }
    if (found.answer == Answer::unknown) found.distance = Outcome::none;
    return found;
  }

  std::unique_ptr<ConcavePhase> phase_;
  const ConfigurationModel* model_ = nullptr;
  std::vector<ConcaveBody> bodies_;
  std::vector<IndexPair> touching_;
};

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<ConfigurationEntry> oracle_exact_configuration() {
  return {
      {.info = {.name = "exact",
                .citation = "exact arithmetic: every pair of parts by itself",
                .origin = Origin::oracle},
       .tasks = {ConfigurationTask::free, ConfigurationTask::distance, ConfigurationTask::motion},
       .make = [](const ConfigurationSettings& settings) {
         return std::make_unique<ExactConfigurations>(settings);
       }}};
}

}  // namespace touchstone::entries
