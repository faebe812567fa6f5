// Asks the oracle that is for the pairs of a set.
#include "harness/campaign/check_pass/exact_answers.h"

namespace touchstone::campaign {

ExactAnswers::ExactAnswers(const measure::BlockInput& input)
    : input_(&input), convex_(input.shapes, executor_) {
  if (!input.bodies.empty()) concave_.emplace(input.bodies);
}

std::string ExactAnswers::key(const measure::NarrowSet& set) {
  const std::string of_pairs = set.broad + "|" + set.kind_name();
  return set.is_concave() ? of_pairs + "|" + std::string(to_string(set.task)) : of_pairs;
}

std::vector<grade::ReferenceOutcome> ExactAnswers::solve(const measure::NarrowSet& set,
                                                         std::size_t frame) {
  const measure::BlockFrame& at = input_->frames[frame];
  const grade::PairGroup& pairs = set.frames[frame];
  if (!set.is_concave()) return convex_.solve(pairs, input_->shape_of, at.poses);
  return concave_->solve(*record::concave_task(set.task), pairs, input_->shape_of, at.poses,
                         at.boxes);
}

}  // namespace touchstone::campaign
