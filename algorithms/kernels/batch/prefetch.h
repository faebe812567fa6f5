// Prefetching of memory before it is read. When a batch has many bodies of different shapes, their
// data is in no near cache. Used by shape_prefetch.h, plane_lanes.h and gjk-lanes.
#pragma once

#include <algorithm>
#include <cstddef>

#include "algorithms/kernels/minkowski/hull_scan.h"

namespace touchstone {

inline constexpr std::size_t cache_line = 64;  // bytes

inline __attribute__((always_inline)) void prefetch(const void* from, std::size_t bytes) {
  const char* const begin = static_cast<const char*>(from);
  for (std::size_t at = 0; at < bytes; at += cache_line) __builtin_prefetch(begin + at);
}

// Prefetches the first blocks of a hull; the hardware prefetcher fetches the rest when they are
// read in order.
template <class Scalar>
inline __attribute__((always_inline)) void prefetch_blocks(
    const hull_scan::VertexBlock<Scalar>* blocks, std::size_t count) {
  constexpr std::size_t most = 2048;  // bytes
  prefetch(blocks, std::min(count * sizeof *blocks, most));
}

// Prefetches the begin of what a scan reads first.
template <class Scalar>
inline __attribute__((always_inline)) void prefetch_hull(
    const hull_scan::ScannedHull<Scalar>& hull) {
  if (hull.rough != nullptr) {
    prefetch_blocks(hull.rough, hull.blocks.size());
  } else {
    prefetch_blocks(hull.blocks.data(), hull.blocks.size());
  }
}

}  // namespace touchstone
