// Solves cases of two bodies that move with one algorithm, and proves the exact answer of one.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "algorithms/registry.h"
#include "harness/files/cases.h"
#include "harness/files/certificates.h"

namespace touchstone::process {

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

}  // namespace touchstone::process
