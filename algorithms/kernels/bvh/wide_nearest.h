// The pairs of leaves of two wide trees that may hold the nearest parts of two placed bodies, the
// nearest boxes first. Used by concave phases.
// Paper: Larsen, Gottschalk, Lin, Manocha, "Fast proximity queries with swept sphere volumes", UNC
//        TR99-018, 1999 (a queue of pairs of nodes; there the volumes are swept spheres).
#pragma once

#include <cstdint>
#include <vector>

#include "algorithms/kernels/bvh/wide_descent.h"

namespace touchstone {

class WideNearest {
 public:
  // Returns the least distance that is known now (metres).
  using Visit = double (*)(void* context, std::uint32_t leaf_a, std::uint32_t leaf_b);

  // Calls `visit` for every pair of leaves but those whose boxes are at least as far apart as the
  // least distance known, which is `known` at first. The boxes of both bodies are moved by the
  // frame's views.
  void run(const WideBvh& a, const WideBvh& b, const DescentFrame& frame, double known, Visit visit,
           void* context);

 private:
  // Children of two nodes, or two leaves.
  struct Open {
    float bound;
    bool is_leaf;
    std::uint8_t lanes_a, lanes_b;
    std::uint32_t a, b;
  };
  std::vector<Open> open_;  // a heap, the nearest on top
};

}  // namespace touchstone
