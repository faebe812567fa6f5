// Exact answers for pairs of bodies that need not be convex.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "algorithms/concave_phase.h"
#include "algorithms/core/aabb.h"
#include "harness/grade/outcome_check.h"
#include "harness/grade/pair_groups.h"

namespace touchstone::grade {

class ConcaveReference {
 public:
  // The bodies of the shapes that groups name; they outlive it.
  explicit ConcaveReference(std::span<const ConcaveBody> bodies);
  // `boxes` has the box of each body. There is no distance of bodies that share a point, and of
  // others only with ConcaveTask::distance.
  std::vector<ReferenceOutcome> solve(ConcaveTask task, const PairGroup& group,
                                      std::span<const std::uint32_t> shape_of,
                                      std::span<const Pose> poses, std::span<const Aabb> boxes);

 private:
  std::unique_ptr<ConcavePhase> oracle_;
};

}  // namespace touchstone::grade
