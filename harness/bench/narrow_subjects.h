// The queries for narrow phases: each algorithm on each two families of shapes, near and far.
#pragma once

#include <string>
#include <vector>

#include "algorithms/registry.h"
#include "harness/bench/placed_pairs.h"

namespace touchstone::bench {

struct NarrowSubject {
  const NarrowPhaseEntry* entry;
  Precision scalar;
  Task task;
  FamilyPair families;
  PairRegime regime;

  std::string name() const;  // "narrow/gjk/double/hull-32/distance/gap-0.1"
};

// All queries of every narrow phase that is built.
std::vector<NarrowSubject> narrow_subjects();

}  // namespace touchstone::bench
