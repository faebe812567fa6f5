// How much random tests try where a sanitizer slows them by ten.
#pragma once

#include <algorithm>
#include <vector>

#include "algorithms/core/isa.h"
#include "algorithms/kernels/simd/target_attributes.h"

namespace touchstone {

// Under a sanitizer, one of so many is tried.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr int one_in = 10;
#else
inline constexpr int one_in = 1;
#endif

constexpr int drawn(int count, int at_least) { return std::max(count / one_in, at_least); }

// The levels of vector instructions that this machine has and this build tells apart.
inline std::vector<Isa> isa_levels() {
  std::vector<Isa> levels = {Isa::baseline};
#if !defined(TOUCHSTONE_ONE_LEVEL)
  if (isa_of_machine() >= Isa::avx2) levels.push_back(Isa::avx2);
#if !defined(TOUCHSTONE_TWO_LEVELS)
  if (isa_of_machine() >= Isa::avx512) levels.push_back(Isa::avx512);
#endif
#endif
  return levels;
}

}  // namespace touchstone
