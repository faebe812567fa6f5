// Part of dynamic-bvh: the bodies whose fat boxes overlap those of the bodies that left theirs.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "algorithms/broad_phase/dynamic_bvh/hilbert_rtree.h"
#include "algorithms/core/executor/executor.h"

namespace touchstone {

class PartnerSearch {
 public:
  // Searches the tree for the partners of each leaver, and calls take(leaver, partners) for each in its
  // order, on the calling thread. The tree has the leavers' new boxes.
  template <class Take>
  void find(Executor& executor, HilbertRTree& bulk, std::span<const std::uint32_t> leavers,
            const Take& take) {
    const std::size_t tasks = block_count(leavers.size(), bodies_a_task);
    if (found_.size() < tasks) found_.resize(tasks);
    const auto look = [&](std::size_t task, int worker) {
      search(bulk, of_task(leavers, task), bulk.scratch(worker), found_[task]);
    };
    executor.run(tasks, std::cref(look));
    for (std::size_t task = 0; task < tasks; ++task) {
      const Partners& found = found_[task];
      const std::span<const std::uint32_t> own = of_task(leavers, task);
      std::size_t begin = 0;
      for (std::size_t i = 0; i < own.size(); ++i) {
        take(own[i], std::span(found.ids).subspan(begin, found.ends[i] - begin));
        begin = found.ends[i];
      }
    }
  }

  std::size_t held_bytes() const;

 private:
  static constexpr std::size_t bodies_a_task = 64;

  // The partners of a task's leavers, and where those of each end.
  struct Partners {
    std::vector<std::uint32_t> ids;
    std::array<std::size_t, bodies_a_task> ends;
  };

  static std::span<const std::uint32_t> of_task(std::span<const std::uint32_t> leavers,
                                                std::size_t task) {
    const std::size_t first = task * bodies_a_task;
    return leavers.subspan(first, std::min(bodies_a_task, leavers.size() - first));
  }
  static void search(const HilbertRTree& bulk, std::span<const std::uint32_t> leavers,
                     Bvh16Scratch& scratch, Partners& out);

  std::vector<Partners> found_;
};

}  // namespace touchstone
