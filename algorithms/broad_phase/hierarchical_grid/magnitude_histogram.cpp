// Part of hierarchical-grid: the parallel count of boxes by magnitude.
#include "algorithms/broad_phase/hierarchical_grid/magnitude_histogram.h"

#include "algorithms/core/executor/parallel_blocks.h"

namespace touchstone {

MagnitudeHistogram magnitude_histogram(Executor& executor, std::span<const Aabb> boxes,
                                       std::span<const std::uint32_t> ids,
                                       std::vector<MagnitudeHistogram>& blocks) {
  constexpr std::size_t block_size = 8192;
  blocks.assign(block_count(ids.size(), block_size), {});
  for_each_block(executor, ids.size(), block_size,
                 [&](std::size_t block, std::size_t first, std::size_t last) {
                   MagnitudeHistogram& into = blocks[block];
                   for (std::size_t i = first; i < last; ++i) {
                     const Aabb& box = boxes[ids[i]];
                     into[magnitude(box)].add(box);
                   }
                 });
  MagnitudeHistogram all{};
  for (const MagnitudeHistogram& block : blocks) {
    for (std::size_t i = 0; i < box_magnitudes; ++i) all[i].add(block[i]);
  }
  return all;
}

}  // namespace touchstone
