// Solves one case with one algorithm: of two bodies at rest, of two that move, or for a contact
// manifold. Used where cases are asked, graded and shrunk.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>

#include "algorithms/pair_query.h"
#include "algorithms/registry.h"
#include "harness/files/cases.h"
#include "harness/files/certificates.h"

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

// Returns true if either body turns.
inline bool turns(const files::CastCase& c) { return c.motion_a.turns() || c.motion_b.turns(); }

// Writes the outcomes of cases of one pair of kinds, in either order, asked in one call: each in the case's
// own order. The entry must be built, and take such pairs and settings.
void solve_casts(const CastEntry& entry, const CastSettings& settings,
                 std::span<const files::CastCase* const> cases, std::span<CastOutcome> outcomes);

// The outcome of one case. The cast is bound for the query alone, so that no case can spoil another's
// answer.
CastOutcome solve_cast(const CastEntry& entry, const CastSettings& settings,
                       const files::CastCase& c);

// The answer of the cast `exact` with its proof; a half-space becomes the second body. The case must be one
// that `exact` takes.
files::StoredCastCertificate prove_cast(const files::CastCase& c, std::optional<double> tolerance);

// Returns why a certificate does not prove its claim, or an empty string if it does.
std::string fault_of(const files::StoredCastCertificate& stored);

// Returns the manifold in the case's own order. The algorithm is made for the query and given the
// two shapes alone. The entry must be built and take such pairs.
Manifold solve_manifold(const ManifoldEntry& entry, const ManifoldSettings& settings,
                        const files::Case& c);

}  // namespace touchstone::process
