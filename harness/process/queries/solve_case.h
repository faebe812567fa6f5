// One query about one case, as `query` asks it and `check` grades it.
#pragma once

#include <array>
#include <memory>

#include "algorithms/registry.h"
#include "harness/files/cases.h"

namespace touchstone::process {

// An algorithm that was made for a case and given its two shapes alone. The entry is built and
// takes such pairs; the case stays alive.
class BoundCase {
 public:
  BoundCase(const NarrowPhaseEntry& entry, const NarrowPhaseSettings& settings,
            const files::Case& c);
  BoundCase(const BoundCase&) = delete;  // the algorithm knows the place of the shapes
  BoundCase& operator=(const BoundCase&) = delete;

  // As solve_case has it.
  Outcome solve(Task task);

 private:
  std::array<Shape, 2> shapes_;
  std::array<Pose, 2> poses_;
  std::unique_ptr<NarrowPhase> narrow_phase_;
};

// The outcome in the case's own order, with what the task asks for and no more: an algorithm may
// know more, but then knows it by chance. The algorithm is bound for the query alone, so that no
// case can spoil another's answer.
Outcome solve_case(const NarrowPhaseEntry& entry, const NarrowPhaseSettings& settings,
                   const files::Case& c, Task task);

}  // namespace touchstone::process
