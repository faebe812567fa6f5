// The pairs of leaves of two wide trees whose boxes may meet, where both bodies are placed: both
// trees are descended together. Used by mid-phases and concave phases.
// Papers: Gottschalk, Lin, Manocha, "OBBTree", SIGGRAPH 1996 (the simultaneous descent; of the
//         fifteen axes the six of the faces are tested); wide_bvh.h has those of the tree.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
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

// Two views of a query: b's boxes in a frame, and a's boxes. The slack is that of `b`.
struct DescentFrame {
  BoxView b;             // its map is used only if `moves_b`
  BoxView a;             // used only if `moves_a`
  bool moves_a = false;  // the frame is not that of a
  bool moves_b = true;   // nor that of b
};

// The reaches are those of common_frame.
DescentFrame descent_frame(const CommonFrame& frame, double reach_a, double reach_b);

// The frame in which boxes are compared, and that of b where b's pose in the first is nearly rigid.
class DescentFrames {
 public:
  DescentFrames(const CommonFrame& frame, double reach_a, double reach_b);

  std::span<const DescentFrame> all() const { return std::span(frames_).first(count_); }

 private:
  std::array<DescentFrame, 2> frames_;
  std::size_t count_ = 1;
};

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
  // frames' axes; b's leaves that are the same come one after the other where they can. Returns false if
  // `visit` ended it.
  bool run(const WideBvh& a, const WideBvh& b, std::span<const DescentFrame> frames, Visit visit,
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
