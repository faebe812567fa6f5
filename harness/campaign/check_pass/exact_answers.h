// The exact answers to the pairs of sets.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "harness/grade/concave/concave_reference.h"
#include "harness/grade/outcome_check.h"
#include "harness/measure/phases/block_input.h"

namespace touchstone::campaign {

class ExactAnswers {
 public:
  // The input outlives it.
  explicit ExactAnswers(const measure::BlockInput& input);
  // Equal for sets whose pairs have the same exact answers. Those of convex bodies serve every task.
  static std::string key(const measure::NarrowSet& set);
  std::vector<grade::ReferenceOutcome> solve(const measure::NarrowSet& set, std::size_t frame);

 private:
  const measure::BlockInput* input_;
  Executor executor_{1};
  grade::Reference convex_;
  std::optional<grade::ConcaveReference> concave_;
};

}  // namespace touchstone::campaign
