// The end points of boxes on one of three axes, kept sorted from frame to frame, and the pairs that
// come or go because end points pass each other.
// Paper:   Baraff, "Dynamic Simulation of Non-Penetrating Rigid Bodies", thesis, Cornell 1992.
// Departs: each axis lists its own changes as if those before it had been repaired, and those
//          behind it had not, so that the three can be repaired at the same time; carried out in
//          the order of the axes, they add up to the frame's. Where most end points stay, those
//          that do not are found by their bodies, and the others are not looked at.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/broad_phase/incremental_sweep_and_prune/endpoint.h"
#include "algorithms/broad_phase/incremental_sweep_and_prune/endpoint_motion.h"
#include "algorithms/core/aabb.h"
#include "algorithms/core/executor.h"
#include "algorithms/core/pair_sink.h"
#include "algorithms/kernels/sorting/radix_sort.h"

namespace touchstone {

class EndpointList {
 public:
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
  // How many end points lie between two places.
  std::size_t count_between(float from, float to) const;

  // Of these bodies, afresh.
  void sort(Executor& executor, std::span<const Aabb> boxes, std::span<const std::uint32_t> ids,
            RadixSort<Endpoint>& radix_sort);
  // Bodies that are marked, by id.
  void take_out(std::span<const std::uint8_t> mark);
  // Bodies that are not there; of those whose boxes are empty nothing is put in.
  void put_in(std::span<const Aabb> boxes, std::span<const std::uint32_t> ids);

  // Brings the end points up to date and lists what pairs come and go by it. False where more than
  // `most_passes` pass each other: they are then of no use.
  bool repair(const EndpointMotion& motion, std::size_t most_passes);
  // A pair may be listed more than once, but never for another change than the axis makes.
  std::span<const Change> changes() const { return changes_; }

  std::size_t held_bytes() const;

 private:
  static constexpr std::ptrdiff_t down = -1, up = 1;
  // Two end points that have changed places.
  struct Pass {
    Endpoint lower, upper;
  };
  using Shadow = std::array<float, 4>;

  // Where on an axis' part of a shadow another axis' part begins.
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
  // The place of an end point in the sorted ones.
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
  std::vector<Endpoint> points_, fresh_;  // the sorted ones; those that are to go to their places
  // By id: where the box lies on the two other axes, minima and maxima with the sign turned, as
  // they are when this axis is repaired: those before it already are.
  std::vector<Shadow> shadows_;
  std::vector<std::uint32_t> places_;             // of minimum and maximum, by id
  bool is_shadowed_ = false, is_placed_ = false;  // whether these are up to date
  std::array<Pass, 1024> passes_;                 // that are yet to be looked at
  std::vector<Change> changes_;
};

}  // namespace touchstone
