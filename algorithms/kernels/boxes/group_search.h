// Group search: up to 16 consecutive boxes that are near each other are tested together against
// others. Boxes outside of the group's bounds are rejected 16 at a time, and each other box is
// tested against the whole group at once. The loops are in group_search.inl. Used by group_scan,
// bvh and loose-octree.
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

#include "algorithms/core/executor/executor.h"
#include "algorithms/core/executor/parallel_blocks.h"
#include "algorithms/core/pair_sink.h"

namespace touchstone {

inline constexpr std::size_t group_size = 16;
inline constexpr std::size_t near_at_once = 512;

// Lists of a search; one for each worker.
struct GroupLists {
  // Places of boxes that overlap a group's bounds and are not tested yet.
  std::array<std::uint32_t, near_at_once + group_size> near;
  // Places of boxes, and for each the bits of those that it overlaps among the 16 boxes from another
  // place on. Most boxes that are tested overlap none, so those that do are listed before their
  // pairs are written. There is room for all that are near, and those of 16 groups.
  static constexpr std::size_t most_hits = near_at_once + (2 + group_size) * group_size;
  std::array<std::uint32_t, most_hits> places, firsts;
  std::array<std::uint16_t, most_hits> bits;
};

// Calls search(group, scratch, out) for each group. A task runs `per_task` groups in turn and
// writes to a chunk of its own, so the pairs and their order do not depend on the width. `scratch`
// holds one entry for each worker.
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
  // std::cref, so that std::function does not allocate.
  executor.run(tasks, std::cref(task));
}

// Repeats a search for the counters in `scratch`, and drops its pairs.
template <class Scratch, class Search>
void count_groups(std::size_t groups, Scratch& scratch, const Search& search) {
  PairBuffer pairs;
  for (std::size_t group = 0; group < groups; ++group) {
    pairs.clear();
    search(group, scratch, pairs);
  }
}

}  // namespace touchstone
