// One answer of all concave phases that are no approximations.
#pragma once

#include <gtest/gtest.h>

#include "tests/algorithms/concave/phases.h"

namespace touchstone::reference {

// Asks all of them, expects the oracle's verdicts and pairs, and returns the oracle's.
inline Answered agreed(const std::array<ConcaveBody, 2>& bodies, const Pose& a, const Pose& b) {
  const Answered truth = ask("exact", ConcaveTask::contacts, bodies, a, b);
  for (const std::string& name : concave_names()) {
    if (registry::find<ConcaveEntry>(name)->approximate) continue;
    SCOPED_TRACE(name);
    const Answered contacts = ask(name, ConcaveTask::contacts, bodies, a, b);
    EXPECT_EQ(contacts.outcome.status, truth.outcome.status);
    EXPECT_EQ(contacts.outcome.answer, truth.outcome.answer);
    EXPECT_EQ(contacts.pairs, truth.pairs);
    const Answered verdict = ask(name, ConcaveTask::intersect, bodies, a, b);
    EXPECT_EQ(verdict.outcome.answer, truth.outcome.answer);
  }
  return truth;
}

}  // namespace touchstone::reference
