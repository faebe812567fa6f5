// Casts of moving pairs with a known answer, and what every cast must keep of it. For tests.
#pragma once

#include "algorithms/core/bounds.h"
#include "algorithms/registry.h"
#include "harness/families/moving_pairs.h"

namespace touchstone::reference {

using families::ContactFeature;
using families::drifting;
using families::meeting;
using families::MovingPairCase;
using families::passing;
using families::pose_at;
using families::random_shape;
using families::scaled;
using families::swapped;
using Random = families::RandomDraws;

CastOutcome solve(const CastEntry& entry, const MovingPairCase& c,
                  const CastSettings& settings = {});

// Counts of answers, for tests that must see both.
struct CastCounts {
  int hits = 0, misses = 0, unknown = 0, brackets = 0;
};

// Fails the test if the outcome contradicts the truth. `tolerance` in metres.
void expect_true(const CastEntry& entry, const MovingPairCase& c, const CastOutcome& outcome,
                 double tolerance, CastCounts& counts);

}  // namespace touchstone::reference
