// An algorithm under test: an entry of the registry, its scalar, and what it is asked.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "algorithms/algorithm_info.h"
#include "algorithms/core/outcome.h"

namespace touchstone::kinds {

class Kind;

struct Contestant {
  const Kind* kind = nullptr;
  const AlgorithmInfo* info = nullptr;
  const void* entry = nullptr;  // what the kind's contract calls an entry, such as RayCastEntry
  Precision scalar = Precision::float64;
  std::uint8_t task = 0;  // place in the kind's tasks
  // True if it is ours and promises that what it does not give up is right.
  bool promised = false;

  // `Entry` is that of the kind.
  template <class Entry>
  const Entry& of() const {
    return *static_cast<const Entry*>(entry);
  }
  std::string_view task_name() const;
  std::string name() const;  // such as "wide-bvh double closest"
};

}  // namespace touchstone::kinds
