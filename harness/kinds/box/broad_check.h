// Checks broad phases against the true pairs, on small scenes of boxes.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "algorithms/core/aabb.h"
#include "algorithms/registry.h"
#include "harness/grade/answer_check.h"
#include "harness/kinds/checker.h"

namespace touchstone::kinds {

using Pairs = std::vector<IndexPair>;  // that ascend

// Returns the pairs of which one body, or both, is among these, which ascend.
Pairs pairs_of(std::span<const std::uint32_t> bodies, const Pairs& pairs);
// Returns the pairs of the one that the other lacks.
Pairs without(const Pairs& from, const Pairs& what);

// A scene whose boxes touch exactly, have no volume, coincide, are huge, tiny or far away, or differ much
// in size.
struct BoxScene {
  std::string name;
  // From frame to frame some boxes move, some leave (their slot is then empty), some come back and
  // some are new. The array never shrinks.
  std::vector<std::vector<Aabb>> frames;
};

// Returns the scenes of a seed, equal on every platform.
std::vector<BoxScene> box_scenes(std::uint64_t seed);

// The faults of the answers to a frame's questions.
struct FrameFaults {
  grade::PairFaults pairs;         // find_pairs
  grade::PairFaults moved, awake;  // find_pairs_of the bodies that moved or came; of a third of all
  grade::PairFaults began, ended;  // find_changes
  grade::PairFaults awake_began, awake_ended;  // find_changes_of that third

  bool none() const;
  std::string words() const;  // such as "1 missing, moved: 2 extra"
};

struct BroadCheck {
  const BroadPhaseEntry* entry = nullptr;
  const BoxScene* scene = nullptr;
  Status status = Status::ok;       // worst status of the frames, also crashed and timed_out
  std::int64_t pairs = 0;           // true pairs over all frames
  std::vector<FrameFaults> frames;  // one for each frame with status ok
  std::string failure;              // reason of a crash or hang, in words

  bool good() const;
  std::string faults() const;  // faults in words; empty if there are none
};

// Checks each broad phase on each scene, in a process of its own: the first frame is built, the
// others are updates. The true pairs are all pairs of closed boxes that share a point, found by
// testing all. Every other question of the contract about a frame is asked too.
std::vector<BroadCheck> check_broad_phases(std::span<const BroadPhaseEntry* const> entries,
                                           std::span<const BoxScene> scenes, double time_limit);

// Checks broad phases, of cases alone: its scenes have no axes and are not counted.
class BoxChecker final : public Checker {
 public:
  explicit BoxChecker(const CheckRequest& request);

  void finish() override;
  std::vector<std::string> ours_wrong() const override;
  std::string text(std::size_t page_width) const override;
  std::string page(const std::string& pictures) const override;

  const std::vector<BroadCheck>& checks() const { return checks_; }

 private:
  std::string sum() const;  // how many find all pairs

  CheckMode mode_;
  std::uint64_t seed_;
  std::vector<const BroadPhaseEntry*> entries_;
  std::vector<BoxScene> scenes_;
  std::vector<BroadCheck> checks_;  // refers to the scenes
};

}  // namespace touchstone::kinds
