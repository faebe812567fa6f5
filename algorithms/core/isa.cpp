// The detection of vector instructions, and their limit.
#include "algorithms/core/isa.h"

#include <algorithm>
#include <atomic>

namespace touchstone {
namespace {

Isa detect() {
#if defined(__x86_64__)
  __builtin_cpu_init();
  if (!__builtin_cpu_supports("avx2")) return Isa::baseline;
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") &&
      __builtin_cpu_supports("bmi2")) {
    return Isa::avx512;
  }
  return Isa::avx2;
#else
  return Isa::baseline;
#endif
}

std::atomic<Isa> chosen{isa_of_machine()};

}  // namespace

Isa isa() { return chosen.load(std::memory_order_relaxed); }

Isa isa_of_machine() {
  static const Isa best = detect();
  return best;
}

void limit_isa(Isa limit) { chosen.store(std::min(limit, isa_of_machine())); }

std::string_view to_string(Isa level) {
  switch (level) {
    case Isa::baseline: return "baseline";
    case Isa::avx2: return "avx2";
    case Isa::avx512: return "avx512";
  }
  return "?";
}

}  // namespace touchstone
