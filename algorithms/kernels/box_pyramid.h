// A tree of boxes without pointers: blocks of 16 boxes that lie one behind the other, the bounds of
// each block, the bounds of 16 blocks, and so on.
//
// The order of the boxes decides how good it is: along a space-filling curve the blocks are small.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/core/broad_phase_work.h"
#include "algorithms/core/executor.h"
#include "algorithms/core/pair_sink.h"
#include "algorithms/kernels/box_arrays.h"

namespace touchstone {

class BoxPyramid {
 public:
  static constexpr std::size_t fan = 16;           // boxes a block, nodes a node
  static constexpr std::size_t group = fan * fan;  // boxes that look for partners together

  // Bounds of the boxes as they stand; these stay alive and unchanged while pairs are looked for.
  void fit(Executor& executor, const BoxArrays& boxes);

  const BoxArrays& boxes() const { return *boxes_; }
  std::size_t groups() const { return (boxes_->size() + group - 1) / group; }
  // levels()[0] bounds blocks, each further level the one before; the last has one node. None where
  // there is no box.
  std::span<const BoxArrays> levels() const { return {levels_.data(), used_}; }
  // Sum over the blocks of the sums of their bounds' sides (metres): what a better order would make
  // smaller.
  double spread() const;
  std::size_t held_bytes() const;

 private:
  const BoxArrays* boxes_ = nullptr;
  std::vector<BoxArrays> levels_;
  std::size_t used_ = 0;
};

// Lists that a search fills and keeps the memory of, and what it counts. One a worker.
struct PyramidScratch {
  static constexpr std::size_t partners_at_once = 64;

  std::vector<std::uint32_t> nodes, children;  // of two levels, one below the other
  std::array<std::vector<float>, 6> bounds;    // of the blocks near a group
  std::vector<std::uint32_t> partners;         // blocks near a block
  std::array<std::uint32_t, (partners_at_once + 1) * BoxPyramid::fan> rows, columns;  // to test
  BroadPhaseWork work{.box_tests = 0, .node_visits = 0, .candidates = 0};

  void make_room(std::size_t blocks);  // as many as the greatest pyramid has
};

// Writes the ids of each pair of boxes that overlap, one of them in this group of `first`, the
// other in `second`. Where the two are one pyramid: each pair once over all groups. Neither is
// empty.
void pair_group(const BoxPyramid& first, std::size_t group, const BoxPyramid& second,
                PyramidScratch& scratch, PairBuffer& out);

}  // namespace touchstone
