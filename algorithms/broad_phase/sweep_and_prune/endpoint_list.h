// Part of sweep-and-prune: the end points of boxes on one of three axes, kept sorted
// from frame to frame, and the pairs that begin or cease to overlap because end points pass each
// other.
// Paper:   Baraff, "Dynamic Simulation of Non-Penetrating Rigid Bodies", thesis, Cornell 1992.
// Departs: each axis lists its own changes as if the axes before it were updated and those after it
//          were not, so that the three can be updated concurrently; applied in the order of the
//          axes, the changes add up to the frame's. If most end points stay, the others are found
//          by their bodies, and those that stay are not visited.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/broad_phase/sweep_and_prune/endpoint.h"
#include "algorithms/broad_phase/sweep_and_prune/endpoint_motion.h"
#include "algorithms/core/aabb.h"
#include "algorithms/core/executor/executor.h"
#include "algorithms/core/pair_sink.h"
#include "algorithms/kernels/sorting/radix_sort.h"

namespace touchstone {

class EndpointList {
 public:
  // A pair that begins (`comes`) or ceases to overlap.
  struct Change {
    IndexPair pair;
    bool comes;
  };
  struct Overlaps {
    std::int64_t candidates = 0;  // pairs that overlap on the axis
    std::int64_t ended = 0;       // bodies that end before the last begins
  };

  explicit EndpointList(std::size_t axis) : axis_(axis) {}

  std::span<const Endpoint> points() const { return points_; }
  Overlaps count_overlaps() const;
  // The number of end points between two coordinates.
  std::size_t count_between(float from, float to) const;

  // Sorts the end points of these bodies from scratch.
  void sort(Executor& executor, std::span<const Aabb> boxes, std::span<const std::uint32_t> ids,
            RadixSort<Endpoint>& radix_sort);
  // Removes the bodies that are marked; `mark` is indexed by id.
  void take_out(std::span<const std::uint8_t> mark);
  // Merges in bodies that are not in the list, except those with empty boxes.
  void put_in(std::span<const Aabb> boxes, std::span<const std::uint32_t> ids);

  // Updates the end points and lists the pairs that come and go by it. Returns false if more than
  // `most_passes` pass each other; the list is then invalid.
  bool repair(const EndpointMotion& motion, std::size_t most_passes);
  // The changes. A pair may be listed more than once, but each time for the axis's change of it.
  std::span<const Change> changes() const { return changes_; }

  std::size_t held_bytes() const;

 private:
  static constexpr std::ptrdiff_t down = -1, up = 1;
  // Two end points that have changed places.
  struct Pass {
    Endpoint lower, upper;
  };
  using Shadow = std::array<float, 4>;

  // The index in this axis's shadows at which another axis's part begins.
  std::size_t part_of(std::size_t other) const {
    return other == (axis_ == 0 ? std::size_t{1} : std::size_t{0}) ? 0 : 2;
  }
  void set_shadow(std::uint32_t id, std::size_t other, const Aabb& box) {
    const std::size_t part = part_of(other);
    shadows_[id][part] = box.min[other];
    shadows_[id][part + 1] = -box.max[other];
  }
  void set_shadows(std::uint32_t id, const Aabb& box) {
    const std::size_t i = axis_ == 0 ? 1 : 0;
    const std::size_t j = axis_ == 2 ? 1 : 2;
    shadows_[id] = {box.min[i], -box.max[i], box.min[j], -box.max[j]};
  }
  // The place of an end point in the sorted array.
  std::uint32_t& place(Endpoint point) {
    return places_[2 * body_of(point) + (is_max(point) ? 1 : 0)];
  }
  void make_shadows(std::span<const Aabb> boxes);
  void make_places(std::size_t id_count);
  bool repair_all(const EndpointMotion& motion, std::size_t most_passes);
  bool repair_few(const EndpointMotion& motion, std::size_t most_passes);
  void cast_shadows(const EndpointMotion& motion, std::size_t first, std::size_t last);
  template <std::ptrdiff_t way, bool with_places>
  std::size_t move(std::span<Endpoint> points, std::size_t at, std::size_t& listed,
                   const EndpointMotion& motion);
  void look_at_passes(std::size_t listed, const EndpointMotion& motion);

  std::size_t axis_;
  std::vector<Endpoint> points_, fresh_;  // the sorted ones; scratch for those to be inserted
  // The extents of each box, by id, on the two other axes: minima, and negated maxima. Axes
  // before this one have this frame's values and those after it the last frame's.
  std::vector<Shadow> shadows_;
  std::vector<std::uint32_t> places_;  // places of the minimum and the maximum of each id
  bool is_shadowed_ = false, is_placed_ = false;  // true while shadows_ and places_ are valid
  std::array<Pass, 1024> passes_;                 // not yet tested
  std::vector<Change> changes_;
};

}  // namespace touchstone
