// Floats as integers of the same order, packed with an index so that one integer sort orders both.
// Used by every broad phase that sorts by a coordinate.
// Paper: Herf, "Radix Tricks", 2001 (the flip of the bits).
#pragma once

#include <bit>
#include <cstdint>

namespace touchstone {

// ordered_key(x) < ordered_key(y) exactly when x < y; -0 and +0 have the same key. NaN has no key.
inline std::uint32_t ordered_key(float x) {
  const auto bits = std::bit_cast<std::uint32_t>(x + 0.0f);  // -0 + 0 is +0
  return bits ^ (bits >> 31 != 0 ? 0xffffffffu : 0x80000000u);
}
// The coordinate of a key; the sign of a zero is lost.
inline float coordinate_of(std::uint32_t key) {
  return std::bit_cast<float>(key ^ (key >> 31 != 0 ? 0x80000000u : 0xffffffffu));
}

// Packs the key above the index: items compare by key first and by index among equal keys.
constexpr std::uint64_t sort_item(std::uint32_t key, std::uint32_t index) {
  return std::uint64_t{key} << 32 | index;
}
constexpr std::uint32_t key_of(std::uint64_t item) {
  return static_cast<std::uint32_t>(item >> 32);
}
constexpr std::uint32_t index_of(std::uint64_t item) { return static_cast<std::uint32_t>(item); }

}  // namespace touchstone
