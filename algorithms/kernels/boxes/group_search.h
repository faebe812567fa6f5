// Up to 16 boxes that lie one behind the other and near each other, tested together against others:
// those that do not meet the group's bounds are left out 16 at a time, and each that is left is
// tested against the whole group at once. The loops are in group_search.inl.
// Paper:   Wald, Boulos, Shirley, "Ray Tracing Deformable Scenes Using Dynamic Bounding Volume
//          Hierarchies", ACM Transactions on Graphics 26, 2007 (a packet's bounds are tested
//          first).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "algorithms/core/executor.h"
#include "algorithms/core/pair_sink.h"
#include "algorithms/core/parallel_blocks.h"

namespace touchstone {

inline constexpr std::size_t group_size = 16;
inline constexpr std::size_t near_at_once = 512;

// The places of boxes that overlap a group's bounds and are yet to be tested.
using NearList = std::array<std::uint32_t, near_at_once + group_size>;

// Calls search(group, scratch, out) for each group, `per_task` of them one after the other, each
// task into a chunk of its own: the same pairs in the same order at every width. `scratch`: one a
// worker.
template <class Scratch, class Search>
void search_groups(Executor& executor, std::size_t groups, std::size_t per_task,
                   std::vector<Scratch>& scratch, PairSink& sink, const Search& search) {
  const std::size_t tasks = block_count(groups, per_task);
  sink.start(tasks);
  const auto task = [&](std::size_t index, int worker) {
    const std::size_t last = std::min((index + 1) * per_task, groups);
    for (std::size_t group = index * per_task; group < last; ++group) {
      search(group, scratch[static_cast<std::size_t>(worker)], sink.chunk(index));
    }
  };
  // By reference, so that std::function does not allocate.
  executor.run(tasks, std::cref(task));
}

// Runs the same search once more for what `scratch` counts; its pairs are dropped.
template <class Scratch, class Search>
void count_groups(std::size_t groups, Scratch& scratch, const Search& search) {
  PairBuffer pairs;
  for (std::size_t group = 0; group < groups; ++group) {
    pairs.clear();
    search(group, scratch, pairs);
  }
}

}  // namespace touchstone
