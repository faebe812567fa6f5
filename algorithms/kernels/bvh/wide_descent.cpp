// The simultaneous descent, and the choice of the instruction level.
//
// v = 2^-24. With m = |R| reach_b + |t| + reach_a (norms of the greatest sum of a row's magnitudes),
// every intermediate result below is at most 2 m. A centre, a half extent and the numbers of the
// view are off by v of themselves; a map has three products and three sums; then there is a
// difference and a sum: together less than 32 v m. The slack is twice that.
#include "algorithms/kernels/bvh/wide_descent.h"

#include <bit>
#include <cmath>

#include "algorithms/kernels/simd/vector.h"

// A node has eight lanes, which is what the second level has.
#if !defined(TOUCHSTONE_TWO_LEVELS)
#define TOUCHSTONE_TWO_LEVELS
#define TOUCHSTONE_DESCENT_HAS_TWO_LEVELS
#endif

namespace touchstone {
namespace {

#define TOUCHSTONE_TARGET_INCLUDE "algorithms/kernels/bvh/wide_descent.inl"
#include "algorithms/kernels/simd/foreach_target.inl"

using SeeBoxes = unsigned (*)(const WideNode&, const BoxView*, float, NodeBoxes&);
SeeBoxes seeing() { return isa() == Isa::baseline ? baseline::see_node : avx2::see_node; }
using MeetBoxes = unsigned (*)(const NodeBoxes&, std::size_t, const NodeBoxes&);

BoxView view_of(const Pose& pose, double slack) {
  BoxView view;
  for (int row = 0; row < 3; ++row) {
    for (int k = 0; k < 3; ++k) {
      view.turn[row][k] = static_cast<float>(pose.rotation(row, k));
      view.spread[row][k] = std::abs(view.turn[row][k]);
    }
    view.offset[row] = static_cast<float>(pose.translation[row]);
  }
  view.slack = round_up(slack);
  return view;
}

double reach_in(const Pose& pose, double reach) {
  return pose.rotation.cwiseAbs().rowwise().sum().maxCoeff() * reach +
         pose.translation.cwiseAbs().maxCoeff();
}

}  // namespace

DescentFrame descent_frame(const CommonFrame& frame, double reach_a, double reach_b) {
  const double far = reach_in(frame.a, reach_a) + reach_in(frame.b, reach_b);
  const double slack = 64 * 0x1p-24 * far + 4 * frame.error + std::numeric_limits<float>::min();
  return {view_of(frame.b, slack), view_of(frame.a, 0), !frame.is_of_a};
}

unsigned see_boxes(const WideNode& node, const BoxView* view, float slack, NodeBoxes& seen) {
  return seeing()(node, view, slack, seen);
}

bool WideDescent::run(const WideBvh& a, const WideBvh& b, const DescentFrame& frame, Visit visit,
                      void* context) {
  if (a.nodes.empty() || b.nodes.empty()) return true;
  const bool plain = isa() == Isa::baseline;
  const SeeBoxes see = seeing();
  const MeetBoxes meet = plain ? baseline::meeting_boxes : avx2::meeting_boxes;
  NodeBoxes boxes_a, boxes_b;
  open_.assign(1, {0, 0, 0xff, 0xff});
  while (!open_.empty()) {
    const Open now = open_.back();
    open_.pop_back();
    const WideNode& node_a = a.nodes[now.node_a];
    const WideNode& node_b = b.nodes[now.node_b];
    const unsigned lanes_b = see(node_b, &frame.b, frame.b.slack, boxes_b) & now.lanes_b;
    unsigned lanes_a = see(node_a, frame.moves_a ? &frame.a : nullptr, 0, boxes_a) & now.lanes_a;
    for (; lanes_a != 0; lanes_a &= lanes_a - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(lanes_a));
      const std::int32_t child_a = node_a.child[i];
      unsigned hits = meet(boxes_a, i, boxes_b) & lanes_b;
      for (; hits != 0; hits &= hits - 1) {
        const int j = std::countr_zero(hits);
        const std::int32_t child_b = node_b.child[static_cast<std::size_t>(j)];
        const bool leaf_a = WideNode::is_leaf(child_a), leaf_b = WideNode::is_leaf(child_b);
        if (leaf_a && leaf_b) {
          if (!visit(context, WideNode::leaf(child_a), WideNode::leaf(child_b))) return false;
          continue;
        }
        Open next = {now.node_a, now.node_b, static_cast<std::uint8_t>(1u << i),
                     static_cast<std::uint8_t>(1u << j)};
        if (!leaf_a) {
          next.node_a = static_cast<std::uint32_t>(child_a);
          next.lanes_a = 0xff;
        }
        if (!leaf_b) {
          next.node_b = static_cast<std::uint32_t>(child_b);
          next.lanes_b = 0xff;
        }
        open_.push_back(next);
      }
    }
  }
  return true;
}

}  // namespace touchstone

#if defined(TOUCHSTONE_DESCENT_HAS_TWO_LEVELS)
#undef TOUCHSTONE_TWO_LEVELS
#undef TOUCHSTONE_DESCENT_HAS_TWO_LEVELS
#endif
