// FCL's broad-phase managers for fcl_broad_phase.cpp: how each is made and updated, and the changes
// of a frame that it accepts. After any other change it is made anew; fcl_broad_phase.cpp says why.
#pragma once

#include <fcl/broadphase/broadphase_SSaP.h>
#include <fcl/broadphase/broadphase_SaP.h>
#include <fcl/broadphase/broadphase_bruteforce.h>
#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/broadphase/broadphase_dynamic_AABB_tree_array.h>
#include <fcl/broadphase/broadphase_interval_tree.h>
#include <fcl/broadphase/broadphase_spatialhash.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>

#include "algorithms/broad_phase.h"
#include "algorithms/peers/world.h"

namespace touchstone::fcl_managers {

using Manager = fcl::BroadPhaseCollisionManager<double>;
using Object = fcl::CollisionObject<double>;

inline fcl::AABB<double> to_fcl(const Aabb& box) {
  return {fcl::Vector3d(box.min[0], box.min[1], box.min[2]),
          fcl::Vector3d(box.max[0], box.max[1], box.max[2])};
}

// A body that consists of its box. FCL looks at the geometry of an object that a tree is asked about.
class BoxObject final : public Object {
 public:
  explicit BoxObject(std::uint32_t id,
                     const std::shared_ptr<fcl::CollisionGeometry<double>>& geometry = nullptr)
      : Object(geometry), id_(id) {}
  std::uint32_t id() const { return id_; }
  void set(const Aabb& box) { aabb = to_fcl(box); }
  void set(std::uint32_t id, const Aabb& box) {
    id_ = id;
    set(box);
  }

 private:
  std::uint32_t id_;
};

// A manager that accepts all changes. The members of this and of each class below: `make` makes the
// manager, `takes` says if it accepts a frame's changes, and `by_list` says if an update from the
// list of moved objects, of so many, pays.
template <class M>
struct Incremental {
  static constexpr bool repeats = false;  // calls back with a pair more than once
  static constexpr bool is_tree = false;  // is asked about single objects
  // A tree's update() of all takes less time than its query.
  static bool by_list(std::size_t, std::size_t) { return false; }
  std::unique_ptr<Manager> make(std::span<const Aabb>) { return std::make_unique<M>(); }
  bool takes(const FrameChange&, std::span<const BoxObject>) const { return true; }
};

struct DynamicTree : Incremental<fcl::DynamicAABBTreeCollisionManager<double>> {
  static constexpr bool is_tree = true;
};

struct SortAndSweep {
  static constexpr bool repeats = true;
  static constexpr bool is_tree = false;
  static bool by_list(std::size_t, std::size_t) { return true; }
  std::unique_ptr<Manager> make(std::span<const Aabb>) {
    return std::make_unique<fcl::SaPCollisionManager<double>>();
  }
  bool takes(const FrameChange& change, std::span<const BoxObject> objects) const {
    if (!change.inserted.empty() || !change.removed.empty()) return false;
    return std::ranges::all_of(change.moved, [&](std::uint32_t id) {
      const fcl::AABB<double>& before = objects[id].getAABB();
      const fcl::AABB<double> now = to_fcl(change.boxes[id]);
      // FCL skips boxes that it takes for equal, and its stored box would then be outdated.
      if (before.equal(now)) return false;
      const auto slides = [&](int i) {
        const double low = now.min_[i] - before.min_[i], high = now.max_[i] - before.max_[i];
        const bool solid = before.min_[i] < before.max_[i] && now.min_[i] < now.max_[i];
        return solid && ((low > 0 && high > 0) || (low < 0 && high < 0) || (low == 0 && high == 0));
      };
      return slides(0) && slides(1) && slides(2);
    });
  }
};

struct DynamicTreeArray {
  static constexpr bool repeats = false;
  static constexpr bool is_tree = true;
  static bool by_list(std::size_t, std::size_t) { return false; }
  std::unique_ptr<Manager> make(std::span<const Aabb>) {
    auto manager = std::make_unique<fcl::DynamicAABBTreeCollisionManager_Array<double>>();
    manager->max_tree_nonbalanced_level = std::numeric_limits<int>::max();
    return manager;
  }
  bool takes(const FrameChange& change, std::span<const BoxObject>) const {
    return change.inserted.empty();
  }
};

struct IntervalTree {
  static constexpr bool repeats = false;
  static constexpr bool is_tree = false;
  static bool by_list(std::size_t, std::size_t) { return false; }
  std::unique_ptr<Manager> make(std::span<const Aabb>) {
    return std::make_unique<fcl::IntervalTreeCollisionManager<double>>();
  }
  bool takes(const FrameChange&, std::span<const BoxObject>) const { return false; }
};

struct SpatialHash {
  static constexpr bool repeats = false;
  static constexpr bool is_tree = false;
  static bool by_list(std::size_t moved, std::size_t live) { return 2 * moved < live; }

  // FCL gives no rule for the cell. This is the mean of the boxes' longest sides (Teschner et al.,
  // "Optimized Spatial Hashing for Collision Detection of Deformable Objects", VMV 2003), but at
  // least a 64th of the limits, or one huge box would fill the memory with its cells. There is a
  // bucket a body, at least FCL's own 1000.
  std::unique_ptr<Manager> make(std::span<const Aabb> boxes) {
    limits_ = World::around(boxes);
    double sum = 0;
    unsigned count = 0;
    for (const Aabb& box : boxes) {
      if (box.is_empty()) continue;
      const fcl::AABB<double> b = to_fcl(box);
      sum += (b.max_ - b.min_).maxCoeff();
      ++count;
    }
    const double mean = count > 0 ? sum / count : 0;
    // FCL's cells are half open, [floor, ceil): two boxes that touch on a border of cells would
    // miss each other, and a flat box there would be in no cell. This factor keeps the borders off
    // all coordinates that occur in practice.
    constexpr double odd = 1.00073612984531;
    const double cell = odd * std::max(mean, limits_.widest() / 64);
    return std::make_unique<fcl::SpatialHashingCollisionManager<double>>(
        cell, fcl::Vector3d(limits_.min.data()), fcl::Vector3d(limits_.max.data()),
        std::max(count, 1000U));
  }
  bool takes(const FrameChange& change, std::span<const BoxObject>) const {
    const auto held = [&](std::uint32_t id) { return limits_.holds(change.boxes[id]); };
    return std::ranges::all_of(change.moved, held) && std::ranges::all_of(change.inserted, held);
  }

 private:
  World limits_;
};

}  // namespace touchstone::fcl_managers
