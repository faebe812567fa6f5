// The pairs of leaves of two wide trees that may hold the nearest parts of two placed bodies. Used by
// concave phases.
// Papers: Larsen, Gottschalk, Lin, Manocha, "Fast proximity queries with swept sphere volumes", UNC
//         TR99-018, 1999 (a queue of pairs of nodes; there the volumes are swept spheres); Quinlan,
//         "Efficient distance computation between non-convex objects", ICRA 1994 (depth first, the
//         nearer child first).
//
// A first descent takes the nearest pair of children each time, so that a distance and a way are known
// before pairs are collected; the search is depth first then, the nearest of a node's pairs first. Bounds
// are those of boxes in several frames, and in one of them that lies along the known way, in which leaves
// have boxes of what they hold.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "algorithms/kernels/bvh/wide_descent.h"

namespace touchstone {

// The least distance that is known (metres), and a frame with an axis along about the way of the nearest
// points, whose lengths are those of the world: bodies that are near each other elsewhere too mostly are
// along about that way, and surfaces lie across it, so that boxes in that frame are thin. Null if there is
// none yet. `turns` is the number of such frames so far, of which this is the last.
struct NearestKnown {
  double distance;
  const DescentFrame* along;
  std::uint32_t turns;
};

// A box, of one of both bodies.
struct LeafBox {
  std::array<float, 3> centre, half;
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
  // Returns a box around what a leaf holds in the last frame along the way, off by less than the frame's
  // slack.
  using Measure = LeafBox (*)(void* context, bool of_b, std::uint32_t leaf);

  // Calls `visit` for every pair of leaves but those whose boxes are at least as far apart as the
  // least distance known; one pair twice. There are one or two frames. If `measure` is null, boxes of
  // leaves are those of the tree.
  void run(const WideBvh& a, const WideBvh& b, std::span<const NearestFrame> frames, Visit visit,
           Measure measure, void* context);

 private:
  // Children of two nodes: a bit for each child that is meant. One of each if both are leaves.
  struct Open {
    float bound;
    bool is_leaf;
    std::uint8_t lanes_a, lanes_b;
    std::uint32_t a, b;
  };
  // The children of a node in a frame along the way, and the box around all of them.
  struct Along {
    std::uint64_t turn = 0;  // of the frame; none has 0
    std::uint32_t node = 0;
    unsigned lanes = 0;  // of children that are not empty
    std::array<float, 3> low, high;
    NodeBoxes boxes;
  };
  // What was seen lately: a node has one place.
  using AlongCache = std::array<Along, 128>;
  struct Search;

  std::vector<Open> open_;  // a stack
  std::unique_ptr<std::array<AlongCache, 2>> along_;
  std::uint64_t turns_ = 0;  // of all runs before
};

}  // namespace touchstone
