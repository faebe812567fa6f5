// ODE's spaces and the geoms in them, for ode_broad_phase.cpp: how each space is made, and the
// changes of a frame that it accepts; after any other change it is made anew.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>

#include "algorithms/broad_phase.h"
#include "algorithms/peers/ode_library.h"
#include "algorithms/peers/world.h"

namespace touchstone::ode_spaces {

inline constexpr float greatest = std::numeric_limits<float>::max();

// The data of a geom: its box in ODE's order, and its body's id.
struct Body {
  std::array<dReal, 6> box;  // min, max on x, then on y, then on z
  std::uint32_t id;
};

inline Body& body_of(dGeomID geom) { return *static_cast<Body*>(dGeomGetClassData(geom)); }

// An offset added to all coordinates before ODE gets them (metres).
using Shift = std::array<double, 3>;

inline void set_box(Body& body, const Aabb& box, const Shift& by) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    body.box[2 * axis] = static_cast<dReal>(box.min[axis] + by[axis]);
    body.box[2 * axis + 1] =
        box.max[axis] < greatest ? static_cast<dReal>(box.max[axis] + by[axis]) : dInfinity;
  }
}

// Returns the class of our geoms: ODE has room for four. The caller holds the library's lock.
inline int geom_class() {
  static const int kind = [] {
    dGeomClass boxes{};
    boxes.bytes = sizeof(Body);
    boxes.collider = [](int) -> dColliderFn* { return nullptr; };
    boxes.aabb = [](dGeomID geom, dReal aabb[6]) { std::ranges::copy(body_of(geom).box, aabb); };
    return dCreateGeomClass(&boxes);
  }();
  return kind;
}

class Hash {
 public:
  static constexpr std::size_t most_bodies = (std::size_t{1} << 17) - 1;

  dSpaceID start(std::span<const Aabb> boxes) {
    world_ = World::around(boxes);
    int least = std::numeric_limits<int>::max();
    most_ = std::numeric_limits<int>::min();
    for (const Aabb& box : boxes) {
      if (box.is_empty()) continue;
      least = std::min(least, level_of(box));
      most_ = std::max(most_, level_of(box));
    }
    const dSpaceID space = dHashSpaceCreate(nullptr);
    if (least > most_) return space;  // no body
    least = std::max(least, finest(world_.widest()));
    // A cell's address is 1000 level + 100 x + 10 y + z, unsigned. If that passes zero inside a
    // box, ODE looks for the box's cells in other places than those where it put them.
    for (std::size_t axis = 0; axis < 3; ++axis) shift_[axis] = -world_.min[axis];
    if (least < 0) {
      const int worst = std::min(most_, -1);
      const double room = std::ldexp(10.0 * -worst + 1, worst);
      shift_[0] += room;
      least = std::max(least, finest(world_.widest() + room));
    }
    dHashSpaceSetLevels(space, least, std::max(least, most_));
    return space;
  }

  bool takes(const FrameChange& change) const {
    const auto held = [&](std::uint32_t id) {
      return world_.holds(change.boxes[id]) && level_of(change.boxes[id]) <= most_;
    };
    return std::ranges::all_of(change.moved, held) && std::ranges::all_of(change.inserted, held);
  }

  const Shift& shift() const { return shift_; }

 private:
  // The cells that ODE chooses for a box are 2^level wide. A point's level is 0.
  static int level_of(const Aabb& box) {
    double side = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      side = std::max(side, double{box.max[axis]} - box.min[axis]);
    }
    int level = 0;
    std::frexp(side, &level);
    return level;
  }
  // The level at which 2^30 cells span `reach`.
  static int finest(double reach) {
    int level = 0;
    std::frexp(reach, &level);
    return level - 30;
  }

  World world_;
  Shift shift_{};
  int most_ = 0;
};

class QuadTree {
 public:
  static constexpr std::size_t most_bodies = std::numeric_limits<std::size_t>::max();

  dSpaceID start(std::span<const Aabb> boxes) {
    world_ = World::around(boxes);
    dVector3 centre{}, extents{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      centre[axis] = static_cast<dReal>(world_.min[axis] / 2 + world_.max[axis] / 2);
      extents[axis] = static_cast<dReal>(world_.max[axis] / 2 - world_.min[axis] / 2);
    }
    constexpr int deepest = 10;  // a million leaves, which ODE allocates at once
    int depth = 1;
    while (depth < deepest && (std::size_t{1} << 2 * depth) < boxes.size()) ++depth;
    return dQuadTreeSpaceCreate(nullptr, centre, extents, depth);
  }

  bool takes(const FrameChange& change) const {
    const auto held = [&](std::uint32_t id) { return world_.holds(change.boxes[id]); };
    return std::ranges::all_of(change.moved, held) && std::ranges::all_of(change.inserted, held);
  }
  static Shift shift() { return {}; }

 private:
  World world_;
};

class Sweep {
 public:
  static constexpr std::size_t most_bodies = std::numeric_limits<std::size_t>::max();

  static dSpaceID start(std::span<const Aabb> boxes) {
    const World world = World::around(boxes);
    std::array<int, 3> axes = {0, 1, 2};
    std::ranges::stable_sort(axes, std::greater{}, [&](int axis) {
      const auto i = static_cast<std::size_t>(axis);
      return world.max[i] - world.min[i];
    });
    return dSweepAndPruneSpaceCreate(nullptr, axes[0] | axes[1] << 2 | axes[2] << 4);
  }
  static bool takes(const FrameChange&) { return true; }
  static Shift shift() { return {}; }
};

}  // namespace touchstone::ode_spaces
