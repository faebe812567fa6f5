// Broad phases against the pairs that there are.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "algorithms/registry.h"
#include "harness/check/broad/box_scenes.h"
#include "harness/grade/pair_check.h"

namespace touchstone::check {

struct BroadCheck {
  const BroadPhaseEntry* entry = nullptr;
  const BoxScene* scene = nullptr;
  Status status = Status::ok;             // the worst of the frames; crashed and timed_out too
  std::int64_t pairs = 0;                 // that there are, over all frames
  std::vector<grade::PairFaults> frames;  // of each frame that was answered with ok
  std::string failure;                    // what became of a lost one, in words

  bool good() const;
  std::string faults() const;  // in words; empty where it is good
};

// Each broad phase on each scene, in a process of its own: the first frame is built, the others are
// updates. The truth is every pair of closed boxes that share a point, found by testing all.
std::vector<BroadCheck> check_broad_phases(std::span<const BroadPhaseEntry* const> entries,
                                           std::span<const BoxScene> scenes, double time_limit);

}  // namespace touchstone::check
