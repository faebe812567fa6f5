// Asks the oracle about pairs of bodies, part by part.
#include "harness/grade/concave/concave_reference.h"

#include <algorithm>
#include <cmath>

#include "algorithms/registry.h"

namespace touchstone::grade {
namespace {

void grow(ReferenceOutcome& reference, const Aabb& box) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double low = box.min[axis], high = box.max[axis];
    reference.size = std::max(reference.size, high - low);
    reference.reach = std::max({reference.reach, std::abs(low), std::abs(high)});
  }
}

}  // namespace

ConcaveReference::ConcaveReference(std::span<const ConcaveBody> bodies)
    : oracle_(registry::find<ConcaveEntry>("exact")->make({})) {
  oracle_->bind(bodies);
}

std::vector<ReferenceOutcome> ConcaveReference::solve(ConcaveTask task, const PairGroup& group,
                                                      std::span<const std::uint32_t> shape_of,
                                                      std::span<const Pose> poses,
                                                      std::span<const Aabb> boxes) {
  std::vector<ReferenceOutcome> reference(group.size());
  std::vector<IndexPair> pairs;
  for (std::size_t i = 0; i < group.size(); ++i) {
    ReferenceOutcome& result = reference[i];
    const std::uint32_t a = group.first[i], b = group.second[i];
    grow(result, boxes[a]);
    grow(result, boxes[b]);
    Outcome outcome;
    pairs.clear();
    oracle_->solve(task, {shape_of[a], poses[a]}, {shape_of[b], poses[b]}, outcome, pairs);
    // Where the oracle is not certain of all parts, its list is not held against others.
    if (outcome.status == Status::ok) result.answer = outcome.answer;
    if (outcome.answer == Answer::separated) result.distance = outcome.distance;
    if (task == ConcaveTask::contacts) result.parts = part_list(pairs);
  }
  return reference;
}

}  // namespace touchstone::grade
