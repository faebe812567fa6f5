// Solves one case of two bodies at rest with one algorithm, or for a contact manifold. Used where cases are asked,
// graded and shrunk.
#pragma once

#include <array>

#include "algorithms/pair_query.h"
#include "algorithms/registry.h"
#include "harness/files/cases.h"

namespace touchstone::process {

// An algorithm that is made for one case and bound to its two shapes alone. The entry must be built
// and take such pairs; the case must outlive this object.
class BoundCase {
 public:
  BoundCase(const NarrowPhaseEntry& entry, const NarrowPhaseSettings& settings,
            const files::Case& c);
  BoundCase(const BoundCase&) = delete;  // the algorithm points to the shapes
  BoundCase& operator=(const BoundCase&) = delete;

  // Answers as solve_case does.
  Outcome solve(Task task);

 private:
  std::array<Shape, 2> shapes_;
  std::array<Pose, 2> poses_;
  PairQuery query_;
};

// Returns the outcome in the case's own order, with only what the task asks for: further values
// that an algorithm fills in are not part of its promise. The algorithm is bound for the query
// alone, so that no case can spoil another's answer.
Outcome solve_case(const NarrowPhaseEntry& entry, const NarrowPhaseSettings& settings,
                   const files::Case& c, Task task);

// Returns the manifold in the case's own order. The algorithm is made for the query and given the
// two shapes alone. The entry must be built and take such pairs.
Manifold solve_manifold(const ManifoldEntry& entry, const ManifoldSettings& settings,
                        const files::Case& c);

}  // namespace touchstone::process
