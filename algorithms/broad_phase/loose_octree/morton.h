// Part of loose-octree: Morton codes, which interleave the bits of three cell numbers.
// Paper: Morton, "A Computer Oriented Geodetic Data Base and a New Technique in File Sequencing",
//        IBM 1966.
#pragma once

#include <array>
#include <cstdint>

namespace touchstone {

// Puts two zeros between the bits of x < 2^21.
constexpr std::uint64_t spread_bits(std::uint64_t x) {
  x = (x | x << 32) & 0x001f00000000ffff;
  x = (x | x << 16) & 0x001f0000ff0000ff;
  x = (x | x << 8) & 0x100f00f00f00f00f;
  x = (x | x << 4) & 0x10c30c30c30c30c3;
  return (x | x << 2) & 0x1249249249249249;
}
// The inverse of spread_bits: every third bit of x.
constexpr std::uint64_t gather_bits(std::uint64_t x) {
  x &= 0x1249249249249249;
  x = (x | x >> 2) & 0x10c30c30c30c30c3;
  x = (x | x >> 4) & 0x100f00f00f00f00f;
  x = (x | x >> 8) & 0x001f0000ff0000ff;
  x = (x | x >> 16) & 0x001f00000000ffff;
  return (x | x >> 32) & 0x00000000001fffff;
}

// Returns spread_bits(x + 1) for spread_bits(x).
constexpr std::uint64_t next_spread(std::uint64_t spread) {
  constexpr std::uint64_t others = ~std::uint64_t{0x1249249249249249};
  return ((spread | others) + 1) & ~others;
}

using CellNumbers = std::array<std::uint32_t, 3>;

constexpr std::uint64_t morton_code(const CellNumbers& cell) {
  return spread_bits(cell[0]) | spread_bits(cell[1]) << 1 | spread_bits(cell[2]) << 2;
}
constexpr CellNumbers morton_cell(std::uint64_t code) {
  return {static_cast<std::uint32_t>(gather_bits(code)),
          static_cast<std::uint32_t>(gather_bits(code >> 1)),
          static_cast<std::uint32_t>(gather_bits(code >> 2))};
}

}  // namespace touchstone
