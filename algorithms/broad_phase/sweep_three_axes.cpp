// Sweep on three axes: sort the ends of the boxes on each axis, list the pairs that overlap on it, and
// intersect the three lists.
// Paper:   Baraff, "Dynamic Simulation of Non-Penetrating Rigid Bodies", thesis, Cornell 1992, and
//          Cohen, Lin, Manocha, Ponamgi, "I-COLLIDE", I3D 1995.
// Steps:   1. On each axis, sort the 2n box ends: radix sort, or insertion sort from the last
//             frame's order while that takes few moves.
//          2. Sweep each axis once: number the boxes by their minima (rank), and note for each the
//             last box that starts before it ends. The boxes in between are its run.
//          3. The lengths of the runs sum up to the axis's number of pairs; pick the axis with the
//             fewest.
//          4. Store each box's three runs as if they were the box, in the order of that axis.
//          5. Go through the runs of that axis, a vector of boxes at a time.
//          6. Report a pair if on both other axes one box's rank lies in the other's run.
// Departs: a list on one axis can hold O(n^2) pairs, so it is stored as runs: in the order of the
//          minima, the boxes that overlap box i and start after it are those at the places
//          rank(i)+1 .. end(i). Three lists thus take O(n) memory and lose nothing. The shortest is
//          traversed, and tests of the other two compare places, never coordinates.
// Fails:   takes time in proportion to the shortest of the three lists: quadratic in dense
//          clusters, n^(5/3) in uniform scenes. Returns Status::capacity beyond 2^30 boxes.
// Cost:    O(n log n + k) time, O(n) memory beside the output; k = pairs on the shortest list.
#include <algorithm>
#include <array>
#include <bit>

#include "algorithms/broad_phase.h"
#include "algorithms/core/memory_usage.h"
#include "algorithms/kernels/boxes/aabb_scan.h"
#include "algorithms/kernels/boxes/structure_boxes.h"
#include "algorithms/kernels/sorting/insertion_sort.h"
#include "algorithms/kernels/sorting/ordered_key.h"
#include "algorithms/kernels/sorting/radix_sort.h"

namespace touchstone {
namespace {

class SweepThreeAxes final : public BroadPhase {
 public:
  explicit SweepThreeAxes(Executor& executor) : executor_(executor) {}

  void build(std::span<const Aabb> boxes) override {
    list_bodies(executor_, boxes, ids_);
    if (ids_.size() > most_boxes) return;
    for (Axis& axis : axes_) sort(axis, boxes);
    sweep();
  }

  void update(const FrameChange& change) override {
    if (!change.inserted.empty() || !change.removed.empty()) return build(change.boxes);
    if (ids_.size() > most_boxes) return;
    for (Axis& axis : axes_) {
      for_each_block(executor_, axis.ends.size(), 8192,
                     [&](std::size_t, std::size_t first, std::size_t last) {
                       for (std::size_t i = first; i < last; ++i) {
                         axis.ends[i] = item(axis, change.boxes, index_of(axis.ends[i]));
                       }
                     });
      if (!insertion_sort(std::span(axis.ends), 4)) sort(axis, change.boxes);
    }
    sweep();
  }

  Status find_pairs(PairSink& sink) override {
    if (ids_.size() > most_boxes) {
      sink.start(0);
      return Status::capacity;
    }
    sink.start(block_count(runs_.size(), rows_a_task));
    for_each_block(executor_, runs_.size(), rows_a_task,
                   [&](std::size_t task, std::size_t first, std::size_t last) {
                     sweep_boxes(runs_, shortest_, {first, last}, sink.chunk(task));
                   });
    return Status::ok;
  }

  BroadPhaseWork work() const override {
    if (ids_.size() > most_boxes) return {};
    BroadPhaseWork work = work_of_sweep(runs_, shortest_, {0, runs_.size()}, runs_.size());
    work.bytes = sum_held_bytes(ids_, radix_sort_, runs_);
    for (const Axis& axis : axes_) work.bytes += sum_held_bytes(axis.ends, axis.rank, axis.end);
    return work;
  }

  // The intervals on the axis with the shortest list, which is the one that is traversed. Boxes are
  // not kept, but their ends are.
  std::vector<StructureBox> structure() const override {
    if (ids_.size() > most_boxes) return {};
    std::vector<Aabb> boxes(ids_.size());
    for (const Axis& axis : axes_) {
      for (const std::uint64_t end : axis.ends) {
        Aabb& box = boxes[index_of(end) & ~is_max];
        ((index_of(end) & is_max) != 0 ? box.max : box.min)[axis.number] =
            coordinate_of(key_of(end));
      }
    }
    return intervals_of(boxes, static_cast<std::size_t>(shortest_));
  }

 private:
  static constexpr std::size_t rows_a_task = 512;
  static constexpr std::size_t most_boxes = std::size_t{1} << 30;
  static constexpr std::uint32_t is_max = std::uint32_t{1} << 31;

  struct Axis {
    std::size_t number;
    // (key of the coordinate, is_max or 0 + place in ids_), ascending. At equal coordinates a start
    // precedes an end, because boxes that touch overlap.
    std::vector<std::uint64_t> ends;
    std::vector<std::uint32_t> rank, end;  // first and last place of each box's run
    std::uint64_t pairs;                   // length of the axis's list
  };

  std::uint64_t item(const Axis& axis, std::span<const Aabb> boxes, std::uint32_t which) const {
    const Aabb& box = boxes[ids_[which & ~is_max]];
    return sort_item(
        ordered_key((which & is_max) != 0 ? box.max[axis.number] : box.min[axis.number]), which);
  }

  void sort(Axis& axis, std::span<const Aabb> boxes) {
    const std::size_t count = ids_.size();
    axis.ends.resize(2 * count);
    for_each_block(executor_, count, 8192, [&](std::size_t, std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        const auto which = static_cast<std::uint32_t>(i);
        axis.ends[i] = item(axis, boxes, which);
        axis.ends[count + i] = item(axis, boxes, which | is_max);
      }
    });
    radix_sort_(executor_, axis.ends, 32, key_of);
  }

  // Makes each axis's list, and stores the runs in the order of the shortest.
  void sweep() {
    const auto list = [&](std::size_t a, int) { make_list(axes_[a]); };
    executor_.run(axes_.size(), std::cref(list));
    const auto at = std::ranges::min_element(axes_, {}, &Axis::pairs);
    shortest_ = static_cast<int>(at - axes_.begin());

    runs_.resize(ids_.size());
    for_each_block(executor_, ids_.size(), 8192,
                   [&](std::size_t, std::size_t first, std::size_t last) {
                     for (std::size_t i = first; i < last; ++i) {
                       Aabb run;
                       for (const Axis& axis : axes_) {
                         run.min[axis.number] = as_float(axis.rank[i]);
                         run.max[axis.number] = as_float(axis.end[i]);
                       }
                       runs_.set(at->rank[i], run, ids_[i]);
                     }
                   });
  }

  void make_list(Axis& axis) const {
    axis.rank.resize(ids_.size());
    axis.end.resize(ids_.size());
    axis.pairs = 0;
    std::uint32_t started = 0;
    for (const std::uint64_t end : axis.ends) {
      const std::uint32_t which = index_of(end) & ~is_max;
      if ((index_of(end) & is_max) == 0) {
        axis.rank[which] = started++;
      } else {
        axis.end[which] = started - 1;
        axis.pairs += axis.end[which] - axis.rank[which];
      }
    }
  }

  // Maps a place to a float, exactly and in the same order, so that places are tested in vectors as
  // coordinates are. There are 2^30 finite floats from 1 up.
  static float as_float(std::uint32_t place) {
    return std::bit_cast<float>(std::bit_cast<std::uint32_t>(1.0f) + place);
  }

  Executor& executor_;
  std::vector<std::uint32_t> ids_;
  std::array<Axis, 3> axes_{Axis{0, {}, {}, {}, 0}, Axis{1, {}, {}, {}, 0}, Axis{2, {}, {}, {}, 0}};
  RadixSort<std::uint64_t> radix_sort_;
  int shortest_ = 0;
  AabbSoA runs_;  // [rank, end] of each box on each axis
};

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<BroadPhaseEntry> broad_phase_sweep_three_axes() {
  return {{.info = {.name = "sweep-three-axes",
                    .citation = "Baraff, thesis, Cornell 1992; Cohen, Lin, Manocha, Ponamgi, "
                                "\"I-COLLIDE\", I3D 1995; three axes, lists intersected"},
           .make = [](Executor& executor) { return std::make_unique<SweepThreeAxes>(executor); }}};
}

}  // namespace touchstone::entries
