// Makes configuration queries, and says what is right.
#include <algorithm>
#include <cmath>
#include <utility>

#include "algorithms/registry.h"
#include "harness/kinds/configuration/configuration_grade.h"
#include "harness/kinds/configuration/configuration_kind.h"
#include "harness/kinds/mesh/mesh_kind.h"

namespace touchstone::kinds {
namespace {

std::unique_ptr<ConcavePhase> pair_phase(PairAnswers answers) {
  const char* const name = answers == PairAnswers::exact ? "exact" : "fused";
  return make_phase(*registry::find<ConcaveEntry>(name), Precision::float64, false);
}

}  // namespace

std::unique_ptr<ConfigurationQuery> make_query(const ConfigurationEntry& entry,
                                               PairAnswers answers) {
  if (entry.info.origin != Origin::oracle) answers = PairAnswers::fast;
  const char* const narrow = answers == PairAnswers::exact ? "exact" : "certified";
  return entry.make(
      {.narrow_phase = [narrow] { return registry::find<NarrowPhaseEntry>(narrow)->make({}); },
       .concave_phase = [answers] { return pair_phase(answers); }});
}

bool supports(const ConfigurationEntry& entry, const ConfigurationModel& model) {
  return entry.supports == nullptr || entry.supports(model);
}

ConfigurationTruth::ConfigurationTruth(const ConfigurationModel& model, PairAnswers answers)
    : model_(model),
      query_(make_query(*registry::find<ConfigurationEntry>("exact"), answers)),
      phase_(pair_phase(answers)) {
  query_->bind(model);
  for (const ModelPart& part : model.parts) bodies_.push_back(part.body);
  phase_->bind(bodies_);
}

ConfigurationAnswer ConfigurationTruth::answer(ConfigurationTask task, std::span<const Pose> poses,
                                               std::uint32_t steps) {
  ConfigurationAnswer answer;
  query_->solve(task, {poses, model_.links, steps}, {&answer, 1});
  return answer;
}

bool ConfigurationTruth::touches(const IndexPair& pair, std::span<const Pose> links) {
  if (!std::ranges::binary_search(model_.pairs, pair)) return false;
  const Answer answer = outcome_of(ConcaveTask::intersect, pair, links).answer;
  return answer == Answer::touching || answer == Answer::overlapping;
}

Outcome ConfigurationTruth::outcome_of(ConcaveTask task, const IndexPair& pair,
                                       std::span<const Pose> links) {
  const auto at = [&](std::uint32_t i) { return PlacedConcave{i, placed(model_.parts[i], links)}; };
  Outcome outcome;
  std::vector<IndexPair> touching;
  phase_->solve(task, at(pair.a), at(pair.b), outcome, touching);
  return outcome;
}

bool ConfigurationTruth::names_pair(const ConfigurationAnswer& answer,
                                    std::span<const Pose> poses) {
  if (answer.answer == Answer::unknown) return true;
  if (answer.answer == Answer::separated) {
    if (!std::isfinite(answer.distance)) return true;
    if (!std::ranges::binary_search(model_.pairs, answer.pair)) return false;
    const Outcome measured = outcome_of(ConcaveTask::distance, answer.pair, poses);
    if (measured.answer == Answer::unknown) return true;
    return measured.answer == Answer::separated &&
           std::abs(measured.distance - answer.distance) <=
               configuration_margin * configuration_reach(model_, poses);
  }
  const std::size_t steps = poses.size() / model_.links;
  const std::size_t step = answer.step == ConfigurationAnswer::none ? 0 : answer.step;
  return step < steps && touches(answer.pair, poses.subspan(step * model_.links, model_.links));
}

}  // namespace touchstone::kinds
