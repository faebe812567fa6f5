// The pairs of leaves of two wide trees that may hold the nearest parts of two placed bodies, the
// nearest boxes first. Used by concave phases.
// Paper: Larsen, Gottschalk, Lin, Manocha, "Fast proximity queries with swept sphere volumes", UNC
//        TR99-018, 1999 (a queue of pairs of nodes; there the volumes are swept spheres).
#pragma once

#include <cstdint>
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

class WideNearest {
 public:
  // Returns what is known now.
  using Visit = NearestKnown (*)(void* context, std::uint32_t leaf_a, std::uint32_t leaf_b);

  // Calls `visit` for every pair of leaves but those whose boxes are at least as far apart as the
  // least distance known, or their ends along the way. The boxes of both bodies are moved by the
  // frame's views.
  void run(const WideBvh& a, const WideBvh& b, const DescentFrame& frame, Visit visit,
           void* context);

 private:
  // Children of two nodes: a bit for each child that is meant. One of each if both are leaves.
  struct Open {
    float bound;
    bool is_leaf;
    std::uint8_t lanes_a, lanes_b;
    std::uint32_t a, b;
  };
  std::vector<Open> open_;  // a heap, the nearest on top
};

}  // namespace touchstone
