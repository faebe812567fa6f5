// A parallel loop, cut into blocks of a fixed size for an executor.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>

#include "algorithms/core/executor/executor.h"

namespace touchstone {

inline constexpr std::size_t block_count(std::size_t count, std::size_t block_size) {
  return (count + block_size - 1) / block_size;
}

// Calls body(block, first, last) for each block [first, last) of [0, count). The cut depends only
// on `block_size`, so each block computes the same at every width.
template <class Body>
void for_each_block(Executor& executor, std::size_t count, std::size_t block_size,
                    const Body& body) {
  const auto task = [&](std::size_t block, int) {
    const std::size_t first = block * block_size;
    body(block, first, std::min(first + block_size, count));
  };
  // std::cref, so that std::function does not allocate.
  executor.run(block_count(count, block_size), std::cref(task));
}

}  // namespace touchstone
