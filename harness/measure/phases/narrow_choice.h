// A narrow phase with the settings of its measurement.
#pragma once

#include <string>

#include "algorithms/registry.h"

namespace touchstone::measure {

struct NarrowChoice {
  const NarrowPhaseEntry* entry = nullptr;
  NarrowPhaseSettings settings;
  bool warm = false;  // true if each frame starts from the memory that the frames before left

  std::string label() const;  // the label that narrow_label gives
};

}  // namespace touchstone::measure
