// The pairs of leaves of two wide trees whose boxes may meet, where both bodies are placed: both
// trees are descended together. Used by mid-phases and concave phases.
// Papers: Gottschalk, Lin, Manocha, "OBBTree", SIGGRAPH 1996 (the simultaneous descent; of the
//         fifteen axes only the three of the frame are tested); wide_bvh.h has those of the tree.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "algorithms/core/mesh/common_frame.h"
#include "algorithms/kernels/bvh/wide_bvh.h"

namespace touchstone {

// How boxes of one body are seen from the other, in float: once for each query.
struct BoxView {
  // Row by row: the map from b's coordinates into the common frame, and the magnitudes of the
  // rotation's entries.
  std::array<std::array<float, 3>, 3> turn, spread;
  std::array<float, 3> offset;
  // Boxes nearer than this may meet: a bound on the rounding of all that is computed from them
  // (metres).
  float slack;
};

// Two views of a query: b's boxes in the frame, and a's boxes.
struct DescentFrame {
  BoxView b;
  BoxView a;             // used only if `moves_a`
  bool moves_a = false;  // the frame is not that of a
};

// The reaches are those of common_frame.
DescentFrame descent_frame(const CommonFrame& frame, double reach_a, double reach_b);

// The boxes of a node's children in a frame, a lane a child.
struct alignas(64) NodeBoxes {
  std::array<std::array<float, WideNode::fan>, 3> centre, half;
};

// Writes the boxes as the view maps them, if there is one, grown by `slack` (metres); NaN where they
// are boundless. Returns the bits of those that are not empty.
unsigned see_boxes(const WideNode& node, const BoxView* view, float slack, NodeBoxes& seen);

class WideDescent {
 public:
  // Returns false to end the descent.
  using Visit = bool (*)(void* context, std::uint32_t leaf_a, std::uint32_t leaf_b);

  // Calls `visit` for every pair of leaves but those whose boxes are surely apart along one of the
  // frame's axes. Returns false if `visit` ended it.
  bool run(const WideBvh& a, const WideBvh& b, const DescentFrame& frame, Visit visit,
           void* context);

 private:
  // Children of two nodes: a bit for each child that is meant.
  struct Open {
    std::uint32_t node_a, node_b;
    std::uint8_t lanes_a, lanes_b;
  };
  std::vector<Open> open_;
};

}  // namespace touchstone
