// The fingerprint of a set of pairs, and the hash that it uses.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include <fmt/core.h>

#include "algorithms/core/pair_sink.h"

namespace touchstone::base {

// The finaliser of SplitMix64 (Steele, Lea, Flood, "Fast splittable pseudorandom number
// generators", OOPSLA 2014).
constexpr std::uint64_t mix(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
  x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
  return x ^ (x >> 31);
}

// The sum modulo 2^64 of mix(a * 2^32 + b). It does not depend on the order of the pairs.
inline std::uint64_t pair_hash(std::span<const IndexPair> pairs) {
  std::uint64_t sum = 0;
  for (const IndexPair& p : pairs) sum += mix((std::uint64_t{p.a} << 32) + p.b);
  return sum;
}

inline std::string to_hex(std::uint64_t value) { return fmt::format("{:016x}", value); }

}  // namespace touchstone::base
