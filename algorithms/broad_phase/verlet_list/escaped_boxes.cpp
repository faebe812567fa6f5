// Part of verlet-list: finds the escaped boxes, and their pairs.
#include "algorithms/broad_phase/verlet_list/escaped_boxes.h"

#include <algorithm>
#include <array>

#include "algorithms/core/executor/parallel_blocks.h"
#include "algorithms/core/memory_usage.h"
#include "algorithms/kernels/boxes/aabb_measure.h"
#include "algorithms/kernels/boxes/aabb_scan.h"

namespace touchstone {

void EscapedBoxes::start(std::size_t bodies) {
  is_escaped_.assign(bodies, 0);
  ids_.clear();
  searched_ = 0;
}

bool EscapedBoxes::add(Executor& executor, const FrameChange& change, std::vector<Aabb>& grown) {
  constexpr std::size_t block_size = 1024;
  // Cost of searching for one escaped box, in units of a body's share of making the list.
  constexpr std::size_t price = 32;
  const std::span<const Aabb> boxes = change.boxes;
  if (boxes.size() > is_escaped_.size()) {
    is_escaped_.resize(boxes.size(), 0);
    grown.resize(boxes.size(), Aabb::empty());
  }
  const std::size_t most = 64 + boxes.size() / 64;
  const auto escapes = [&](std::uint32_t id) {
    return is_escaped_[id] == 0 && !contains(grown[id], boxes[id]);
  };
  const std::span<const std::uint32_t> moved = change.moved;
  counts_.resize(block_count(moved.size(), block_size));
  for_each_block(executor, moved.size(), block_size,
                 [&](std::size_t block, std::size_t first, std::size_t last) {
                   std::size_t count = 0;
                   for (std::size_t i = first; i < last; ++i) count += escapes(moved[i]) ? 1 : 0;
                   counts_[block] = count;
                 });
  std::size_t all = ids_.size() + change.inserted.size();
  for (const std::size_t count : counts_) all += count;
  searched_ += all;
  if (all > most || searched_ * price > boxes.size() + 64 * price) return false;
  const auto put = [&](std::uint32_t id) {
    if (is_escaped_[id] != 0) return;
    is_escaped_[id] = 1;
    ids_.push_back(id);
  };
  for (const std::uint32_t id : change.inserted) put(id);
  for (std::size_t block = 0; block < counts_.size(); ++block) {
    if (counts_[block] == 0) continue;
    const std::size_t last = std::min((block + 1) * block_size, moved.size());
    for (std::size_t i = block * block_size; i < last; ++i) {
      if (escapes(moved[i])) put(moved[i]);
    }
  }
  boxes_.gather(executor, boxes, ids_.size(), [&](std::size_t i) { return ids_[i]; });
  return true;
}

void EscapedBoxes::search(const ImplicitRTree& tree, std::span<const Aabb> boxes, std::size_t first,
                          std::size_t last, RTreeScratch& scratch, PairBuffer& out) const {
  for (std::size_t i = first; i < last; ++i) {
    const std::uint32_t id = ids_[i];
    const std::size_t found = list_overlaps(tree, boxes[id], scratch);
    scratch.work.candidates += static_cast<std::int64_t>(found);
    for (std::size_t k = 0; k < found; ++k) {
      const std::uint32_t other = scratch.children[k];
      if (!has(other) && overlap(boxes[other], boxes[id])) out.push(id, other);
    }
  }
  const std::array columns{IndexRange{0, ids_.size()}};
  scan_boxes(boxes_, {first, last}, columns, out);
}

std::size_t EscapedBoxes::held_bytes() const {
  return static_cast<std::size_t>(sum_held_bytes(is_escaped_, ids_, boxes_, counts_));
}

}  // namespace touchstone
