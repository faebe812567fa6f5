// Floats as integers of the same order, packed with an index so that whole items can be sorted.
// Paper: Herf, "Radix Tricks", 2001 (the flip of the bits).
#pragma once

#include <bit>
#include <cstdint>

namespace touchstone {

// x < y exactly when ordered_key(x) < ordered_key(y); -0 and +0 have the same key. Not for NaN.
inline std::uint32_t ordered_key(float x) {
  const auto bits = std::bit_cast<std::uint32_t>(x + 0.0f);  // -0 + 0 is +0
  return bits ^ (bits >> 31 != 0 ? 0xffffffffu : 0x80000000u);
}

// Key above, index below: the order of the items is that of the keys, and of the indices where keys
// are equal.
constexpr std::uint64_t sort_item(std::uint32_t key, std::uint32_t index) {
  return std::uint64_t{key} << 32 | index;
}
constexpr std::uint32_t key_of(std::uint64_t item) {
  return static_cast<std::uint32_t>(item >> 32);
}
constexpr std::uint32_t index_of(std::uint64_t item) { return static_cast<std::uint32_t>(item); }

}  // namespace touchstone
