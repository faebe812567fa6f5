// Part of verlet-list: overlap tests of listed pairs, one after the other and without a branch to
// mispredict.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "algorithms/core/aabb.h"
#include "algorithms/core/pair_sink.h"
#include "algorithms/kernels/simd/vector.h"

namespace touchstone {

// Returns overlap(a, b), in two comparisons of four floats: both vectors lie within the box.
inline bool overlap_at_once(const Aabb& a, const Aabb& b) {
  using Lanes = simd::baseline::Simd<float>;
  static_assert(sizeof(Aabb) == 6 * sizeof(float));
  const auto min_first = [](const Aabb& box) {  // x, y, z and one that is ignored
    return Lanes::load(reinterpret_cast<const float*>(&box));
  };
  const auto max_first = [](const Aabb& box) {
    const Lanes::Vector end = Lanes::load(reinterpret_cast<const float*>(&box) + 2);
    return Lanes::Vector{end[1], end[2], end[3], end[0]};
  };
  const Lanes::Mask test = Lanes::less_equal(min_first(a), max_first(b));
  return (Lanes::to_bits(Lanes::less_equal(test, min_first(b), max_first(a))) & 7u) == 7u;
}

// Appends the candidates whose boxes overlap and for which keep(pair) holds.
template <class Keep>
void write_overlapping(std::span<const Aabb> boxes, std::span<const IndexPair> candidates,
                       const Keep& keep, PairBuffer& out) {
  out.reserve(candidates.size());
  IndexPair* end = out.end();
  for (const IndexPair pair : candidates) {
    *end = pair;
    end += static_cast<int>(overlap_at_once(boxes[pair.a], boxes[pair.b]) & keep(pair));
  }
  out.advance(static_cast<std::size_t>(end - out.end()));
}

}  // namespace touchstone
