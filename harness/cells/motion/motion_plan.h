// Cells of motion: a scene's steps, played by casts and by substeps of narrow phases.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "algorithms/registry.h"
#include "harness/kinds/timed_set.h"
#include "harness/scene/scene.h"

namespace touchstone::cells {

// Several algorithms behind each other: a pair goes to the first that takes it.
using CastChain = std::vector<const CastEntry*>;
using NarrowChain = std::vector<const NarrowPhaseEntry*>;

struct MotionRequest {
  std::vector<std::filesystem::path> scenes;
  std::vector<scene::SceneOverrides> overrides = {{}};  // each with every scene
  std::vector<int> threads = {1};
  std::vector<const BroadPhaseEntry*> broad;
  std::vector<CastChain> casts;
  std::vector<NarrowChain> narrow;  // each with every number of substeps
  std::vector<int> substeps;
  std::vector<Precision> scalars = {Precision::float64};  // of the narrow phases
  std::optional<double> tolerance;                        // of the casts, metres
  bool is_linear = false;                                 // leaves rotations out
  int parts = 0;  // of a step, for the broad phase of casts; 0: the cheapest
};

// One way through the steps: casts, or substeps.
struct MotionMethod {
  std::string name = {};  // of its contestant
  const BroadPhaseEntry* broad = nullptr;
  CastChain casts = {};
  NarrowChain narrow = {};
  int substeps = 0;  // 0: casts
  Precision scalar = Precision::float64;

  std::string chain_name() const;  // the algorithms' names, joined by '+'
  Origin origin() const;           // that of the first
};

// The methods of a request, casts first.
std::vector<MotionMethod> methods_of(const MotionRequest& request);

// A cell for each number of threads, in a group for each scene with each of the overrides. A query is a
// body in a step; what is graded are pairs. Throws InputError if a scene cannot be read or does not
// move.
std::vector<kinds::PlannedSet> plan_motion(const MotionRequest& request);

// Reads names joined by '+'. Throws InputError.
CastChain cast_chain(const std::string& names);
NarrowChain narrow_chain(const std::string& names);

}  // namespace touchstone::cells
