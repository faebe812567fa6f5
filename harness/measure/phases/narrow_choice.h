// A narrow phase with the settings of its measurement.
#pragma once

#include <string>

#include "algorithms/registry.h"

namespace touchstone::measure {

// The greatest number of pairs of one call, unless a choice says otherwise. One of the executor's
// tasks solves as many: enough to hide the cost of its dispatch, few enough to share a small group
// between two threads.
inline constexpr int usual_batch = 256;

struct NarrowChoice {
  const NarrowPhaseEntry* entry = nullptr;
  NarrowPhaseSettings settings;
  bool warm = false;        // true if each frame starts from the memory that the frames before left
  int batch = usual_batch;  // the greatest number of pairs of one call

  std::string label() const;  // the label that narrow_label gives
};

}  // namespace touchstone::measure
