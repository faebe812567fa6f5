// Sweep on one axis: sort the boxes on it, sweep, test the other two.
// Paper:   Cohen, Lin, Manocha, Ponamgi, "I-COLLIDE: An Interactive and Exact Collision Detection
//          System for Large-Scale Environments", I3D 1995.
// Steps:   1. Choose the axis along which the boxes' centres vary most. In an update keep the last
//             axis unless its variance falls below three quarters of the best.
//          2. Sort the boxes by their minima on it: radix sort, or insertion sort from the last
//             frame's order while that takes few moves.
//          3. Gather the boxes in that order into one array for each coordinate.
//          4. For each box, test those after it, a vector at a time, on the other two axes.
//          5. Stop at the first that begins after the box's end.
// Departs: sorts one axis instead of three, and only the minima; keeps no list of pairs from frame
//          to frame. Coherence shortens the sort: insertion repairs the last frame's order while
//          that is cheap.
// Fails:   goes quadratic when most boxes overlap on the axis (stacks, walls), and grows like
//          n^(5/3) in scenes that are uniform in three dimensions.
// Cost:    O(n log n + k) time, O(n) memory beside the output; k = pairs that overlap on the axis.
#include <algorithm>
#include <array>

#include "algorithms/broad_phase.h"
#include "algorithms/core/memory_usage.h"
#include "algorithms/kernels/boxes/aabb_scan.h"
#include "algorithms/kernels/boxes/structure_boxes.h"
#include "algorithms/kernels/sorting/insertion_sort.h"
#include "algorithms/kernels/sorting/ordered_key.h"
#include "algorithms/kernels/sorting/radix_sort.h"

namespace touchstone {
namespace {

class SweepOneAxis final : public BroadPhase {
 public:
  explicit SweepOneAxis(Executor& executor) : executor_(executor) {}

  void build(std::span<const Aabb> boxes) override {
    list_bodies(executor_, boxes, ids_);
    const Variances variance = variances(boxes);
    axis_ = static_cast<std::size_t>(std::ranges::max_element(variance) - variance.begin());
    sort(boxes);
    gather(boxes);
  }

  void update(const FrameChange& change) override {
    if (!change.inserted.empty() || !change.removed.empty()) return build(change.boxes);
    // An axis nearly as good as the best stays, because its order is at hand.
    const Variances variance = variances(change.boxes);
    if (variance[axis_] < 0.75 * std::ranges::max(variance)) return build(change.boxes);
    for_each_block(executor_, order_.size(), 8192,
                   [&](std::size_t, std::size_t first, std::size_t last) {
                     for (std::size_t i = first; i < last; ++i) {
                       order_[i] = item(change.boxes, index_of(order_[i]));
                     }
                   });
    if (!insertion_sort(std::span(order_), 4)) sort(change.boxes);
    gather(change.boxes);
  }

  Status find_pairs(PairSink& sink) override {
    sink.start(block_count(arrays_.size(), rows_a_task));
    for_each_block(executor_, arrays_.size(), rows_a_task,
                   [&](std::size_t task, std::size_t first, std::size_t last) {
                     sweep_boxes(arrays_, static_cast<int>(axis_), {first, last}, sink.chunk(task));
                   });
    return Status::ok;
  }

  BroadPhaseWork work() const override {
    BroadPhaseWork work =
        work_of_sweep(arrays_, static_cast<int>(axis_), {0, arrays_.size()}, arrays_.size());
    work.bytes = sum_held_bytes(ids_, sums_, order_, radix_sort_, arrays_);
    return work;
  }

  // The intervals on the sorted axis.
  std::vector<StructureBox> structure() const override {
    return intervals_of(list_boxes(arrays_), axis_);
  }

 private:
  using Variances = std::array<double, 3>;
  static constexpr std::size_t rows_a_task = 512;

  std::uint64_t item(std::span<const Aabb> boxes, std::uint32_t id) const {
    return sort_item(ordered_key(boxes[id].min[axis_]), id);
  }

  void sort(std::span<const Aabb> boxes) {
    order_.resize(ids_.size());
    for_each_block(executor_, ids_.size(), 8192,
                   [&](std::size_t, std::size_t first, std::size_t last) {
                     for (std::size_t i = first; i < last; ++i) order_[i] = item(boxes, ids_[i]);
                   });
    radix_sort_(executor_, order_, 32, key_of);
  }

  void gather(std::span<const Aabb> boxes) {
    arrays_.gather(executor_, boxes, order_.size(),
                   [&](std::size_t i) { return index_of(order_[i]); });
  }

  // The variances of the boxes' centres on each axis, times 4 n. The sums of the blocks are added
  // in their order, so the axis is the same at every width. In double the squares of the greatest
  // floats are finite.
  Variances variances(std::span<const Aabb> boxes) {
    constexpr std::size_t block_size = 8192;
    sums_.assign(block_count(ids_.size(), block_size), {});
    for_each_block(executor_, ids_.size(), block_size,
                   [&](std::size_t block, std::size_t first, std::size_t last) {
                     const Aabb& origin = boxes[ids_[0]];  // offsets from one box: far coordinates
                                                           // cancel
                     Sums sums;
                     for (std::size_t i = first; i < last; ++i) {
                       const Aabb& box = boxes[ids_[i]];
                       for (std::size_t axis = 0; axis < 3; ++axis) {
                         const double x = double{box.min[axis]} - origin.min[axis] +
                                          (double{box.max[axis]} - origin.max[axis]);
                         sums.first[axis] += x;
                         sums.second[axis] += x * x;
                       }
                     }
                     sums_[block] = sums;
                   });
    Variances variance{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      double first = 0;
      double second = 0;
      for (const Sums& sums : sums_) {
        first += sums.first[axis];
        second += sums.second[axis];
      }
      if (!ids_.empty()) {
        variance[axis] = second - first / static_cast<double>(ids_.size()) * first;
      }
    }
    return variance;
  }

  struct Sums {
    std::array<double, 3> first{}, second{};
  };

  Executor& executor_;
  std::vector<std::uint32_t> ids_;
  std::vector<Sums> sums_;
  std::size_t axis_ = 0;
  std::vector<std::uint64_t> order_;  // (key of the minimum, id), ascending
  RadixSort<std::uint64_t> radix_sort_;
  AabbSoA arrays_;  // sorted by the minima
};

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<BroadPhaseEntry> broad_phase_sweep_one_axis() {
  return {{.info = {.name = "sweep-one-axis",
                    .citation = "Cohen, Lin, Manocha, Ponamgi, \"I-COLLIDE\", I3D 1995; one axis"},
           .make = [](Executor& executor) { return std::make_unique<SweepOneAxis>(executor); }}};
}

}  // namespace touchstone::entries
