// The lower bound: radix sort, gather, write.
#include "algorithms/limit.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "algorithms/core/executor/parallel_blocks.h"
#include "algorithms/kernels/sorting/ordered_key.h"
#include "algorithms/kernels/sorting/radix_sort.h"

namespace touchstone {
namespace {

class Limit final : public BroadPhaseLimit {
 public:
  explicit Limit(Executor& executor) : executor_(executor) {}

  void sort_and_gather(std::span<const Aabb> boxes) override {
    items_.resize(boxes.size());
    sorted_.resize(boxes.size());
    for_each_block(executor_, boxes.size(), boxes_a_task,
                   [&](std::size_t, std::size_t first, std::size_t last) {
                     for (std::size_t i = first; i < last; ++i) {
                       items_[i] =
                           sort_item(ordered_key(boxes[i].min[0]), static_cast<std::uint32_t>(i));
                     }
                   });
    sort_(executor_, items_, 32, [](std::uint64_t item) { return key_of(item); });
    for_each_block(executor_, boxes.size(), boxes_a_task,
                   [&](std::size_t, std::size_t first, std::size_t last) {
                     for (std::size_t i = first; i < last; ++i) {
                       sorted_[i] = boxes[index_of(items_[i])];
                     }
                   });
  }

  void write(std::span<const IndexPair> pairs, PairSink& sink) override {
    sink.start(block_count(pairs.size(), pairs_a_task));
    for_each_block(executor_, pairs.size(), pairs_a_task,
                   [&](std::size_t task, std::size_t first, std::size_t last) {
                     PairBuffer& chunk = sink.chunk(task);
                     chunk.reserve(last - first);
                     std::copy_n(&pairs[first], last - first, chunk.end());
                     chunk.advance(last - first);
                   });
  }

 private:
  static constexpr std::size_t boxes_a_task = 16384;
  static constexpr std::size_t pairs_a_task = 65536;

  Executor& executor_;
  RadixSort<std::uint64_t> sort_;
  std::vector<std::uint64_t> items_;
  std::vector<Aabb> sorted_;
};

}  // namespace

std::unique_ptr<BroadPhaseLimit> make_broad_phase_limit(Executor& executor) {
  return std::make_unique<Limit>(executor);
}

}  // namespace touchstone
