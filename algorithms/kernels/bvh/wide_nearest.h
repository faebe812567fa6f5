// The pairs of leaves of two wide trees that may hold the nearest parts of two placed bodies. Used by
// concave phases.
// Papers: Larsen, Gottschalk, Lin, Manocha, "Fast proximity queries with swept sphere volumes", UNC
//         TR99-018, 1999 (a queue of pairs of nodes; there the volumes are swept spheres); Quinlan,
//         "Efficient distance computation between non-convex objects", ICRA 1994 (depth first, the
//         nearer child first).
//
// A first descent takes the nearest pair of children each time, so that a distance and a way are known
// before pairs are collected; the search is depth first then, the nearest of a node's pairs first. Bounds
// are those of boxes in several frames, and of their ends along the known way.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/kernels/bvh/wide_descent.h"

namespace touchstone {

// The least distance that is known (metres), and the unit vector from a's nearest point to b's, in
// the frame: bodies that are near each other elsewhere too mostly are along about that way, so that
// gaps along it bound more than those of boxes. Zero if there is none yet.
struct NearestKnown {
  double distance;
  std::array<float, 3> way;
};

// A frame in which boxes are compared: its lengths times `factor` are at most those of the world.
struct NearestFrame {
  DescentFrame frame;
  bool is_of_b;  // the frame's first body is b
  float factor;
};

class WideNearest {
 public:
  // Returns what is known now.
  using Visit = NearestKnown (*)(void* context, std::uint32_t leaf_a, std::uint32_t leaf_b);

  // Calls `visit` for every pair of leaves but those whose boxes are at least as far apart as the
  // least distance known, or their ends along the way; one pair twice. `world` has the lengths of
  // the world, and is that of the way. There is at least one other frame, which may be `world`.
  void run(const WideBvh& a, const WideBvh& b, const DescentFrame& world,
           std::span<const NearestFrame> frames, Visit visit, void* context);

 private:
  // Children of two nodes: a bit for each child that is meant. One of each if both are leaves.
  struct Open {
    float bound;
    bool is_leaf;
    std::uint8_t lanes_a, lanes_b;
    std::uint32_t a, b;
  };
  struct Search;
  std::vector<Open> open_;  // a stack
};

}  // namespace touchstone
