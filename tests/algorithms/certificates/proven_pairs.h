// What proofs of pairs of bodies are expected to say, for tests.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "tests/algorithms/certificates/bodies.h"

namespace touchstone::reference {

struct ProofCounts {
  int separated = 0, overlapping = 0, unknown = 0, inside = 0, met = 0;
};

// What is proven is what the solver says, whose answers are known unless `may_be_unknown`.
inline void expect_proven(const ProvenPair& pair, const std::string& what, ProofCounts& counts,
                          bool may_be_unknown = false) {
  for (const PartsClaim claim : all_claims) {
    const PartsCertificate proof = pair.prove(claim);
    const Answered solved = pair.solve(claim);
    EXPECT_EQ(pair.fault(proof), "") << what;
    if (!may_be_unknown || proof.answer == Answer::unknown) {
      EXPECT_EQ(proof.answer, solved.outcome.answer) << what;
    } else if (solved.outcome.answer != Answer::unknown) {
      EXPECT_EQ(proof.answer, solved.outcome.answer) << what;
    }
    if (claim == PartsClaim::contacts && proof.undecided == 0) {
      EXPECT_EQ(met_pairs(proof), solved.pairs) << what;
      counts.met += static_cast<int>(solved.pairs.size());
    }
    if (proof.bounds && solved.outcome.answer == Answer::separated) {
      EXPECT_EQ(proof.bounds->lower, std::max(0.0, solved.outcome.lower)) << what;
      EXPECT_LE(proof.bounds->upper, solved.outcome.upper * (1 + 1e-12)) << what;
    }
    counts.inside += proof.inside ? 1 : 0;
    if (proof.answer == Answer::separated) ++counts.separated;
    if (proof.answer == Answer::overlapping) ++counts.overlapping;
    if (proof.answer == Answer::unknown) ++counts.unknown;
  }
}

}  // namespace touchstone::reference
