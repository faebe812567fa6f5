#include "algorithms/kernels/box_arrays.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace touchstone {

void BoxArrays::resize(std::size_t count) {
  if (count + padding > stride_) {
    stride_ = (count + count / 2) / padding * padding + 2 * padding;
    extents_.reset(new (alignment) float[6 * stride_]);
    ids_ = std::make_unique_for_overwrite<std::uint32_t[]>(stride_);
  }
  size_ = count;
  for (std::size_t place = count; place < count + padding; ++place) set(place, Aabb::empty(), 0);
}

void list_bodies(Executor& executor, std::span<const Aabb> boxes, std::vector<std::uint32_t>& ids) {
  constexpr std::size_t block_size = 8192;
  // Each block lists its own at its own place; the gaps are closed afterwards, and mostly there are
  // none.
  ids.resize(boxes.size());
  std::vector<std::size_t> counts(block_count(boxes.size(), block_size));
  for_each_block(executor, boxes.size(), block_size,
                 [&](std::size_t block, std::size_t first, std::size_t last) {
                   std::size_t end = first;
                   for (std::size_t i = first; i < last; ++i) {
                     ids[end] = static_cast<std::uint32_t>(i);
                     end += boxes[i].is_empty() ? 0 : 1;
                   }
                   counts[block] = end - first;
                 });
  std::size_t end = 0;
  for (std::size_t block = 0; block < counts.size(); ++block) {
    const auto from = ids.begin() + static_cast<std::ptrdiff_t>(block * block_size);
    const auto to = ids.begin() + static_cast<std::ptrdiff_t>(end);
    if (from != to) std::copy_n(from, counts[block], to);
    end += counts[block];
  }
  ids.resize(end);
}

}  // namespace touchstone
