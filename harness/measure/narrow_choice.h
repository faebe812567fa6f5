// A narrow phase or a concave phase with the settings of its measurement.
#pragma once

#include <memory>
#include <string>

#include "algorithms/registry.h"
#include "harness/measure/block_input.h"

namespace touchstone::measure {

// The greatest number of pairs of one call, unless a choice says otherwise. One of the executor's
// tasks solves as many: enough to hide the cost of its dispatch, few enough to share a small group
// between two threads.
inline constexpr int usual_batch = 256;

struct NarrowChoice {
  const NarrowPhaseEntry* entry = nullptr;  // null: a concave phase
  NarrowPhaseSettings settings;             // of a concave phase only the scalar
  bool warm = false;        // true if each frame starts from the memory that the frames before left
  int batch = usual_batch;  // the greatest number of pairs of one call
  const ConcaveEntry* concave = nullptr;  // null: a narrow phase
  const MidPhaseEntry* mid = nullptr;     // of a concave phase

  const AlgorithmInfo& info() const { return entry != nullptr ? entry->info : concave->info; }
  // The algorithm's name; with that of the mid-phase where times depend on it.
  std::string name() const;
  std::string label() const;  // the label that narrow_label gives
  // True if its answers are wrong by design where its numbers are.
  bool is_approximate() const {
    return entry != nullptr ? entry->traits.approximate : concave->approximate;
  }
  // A new concave phase that has these bodies.
  std::unique_ptr<ConcavePhase> make_concave(std::span<const ConcaveBody> bodies) const;
};

// The mid-phase of concave phases, unless a choice says otherwise.
inline constexpr std::string_view usual_mid_phase = "wide-bvh";

// Returns each concave phase with each of its scalars, and those that take any mid-phase with each.
std::vector<NarrowChoice> concave_choices(std::span<const ConcaveEntry* const> entries,
                                          std::span<const MidPhaseEntry* const> mids,
                                          std::span<const Precision> scalars);

enum class Offer : std::uint8_t {
  none,         // the set is not for this kind of phase, or it does not have the task
  unsupported,  // it does not take some of the pairs
  taken,
};
Offer offer(const NarrowChoice& choice, const NarrowSet& set, const BlockInput& input);

}  // namespace touchstone::measure
