// A narrow phase with the settings that it is measured with.
#pragma once

#include <string>

#include "algorithms/registry.h"

namespace touchstone::measure {

struct NarrowChoice {
  const NarrowPhaseEntry* entry = nullptr;
  NarrowPhaseSettings settings;
  bool warm = false;  // each frame is answered with what the frames before left in memory

  std::string label() const;  // as narrow_label gives it
};

}  // namespace touchstone::measure
