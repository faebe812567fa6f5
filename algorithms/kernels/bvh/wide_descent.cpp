// The simultaneous descent, and the choice of the instruction level.
//
// v = 2^-24. With m = |R| reach_b + |t| + reach_a (norms of the greatest sum of a row's magnitudes),
// every intermediate result below is at most 2 m. A centre, a half extent and the numbers of the
// view are off by v of themselves; a map has three products and three sums; then there is a
// difference and a sum: together less than 32 v m. The slack is twice that.
//
// Let b's map be y -> R y + t, and E = R^T R - I. In b's frame its boxes are not turned, and a point x
// of a is seen at R^T (x - t). If x is b's point y, but for the frame's error, then that is off from y by
// at most |E| |y| + |R^T| error, which the slack has twice.
#include "algorithms/kernels/bvh/wide_descent.h"

#include <bit>
#include <cmath>

#include "algorithms/core/mesh/skew.h"
#include "algorithms/kernels/simd/vector.h"

// A node has eight lanes, which is what the second level has.
#if !defined(TOUCHSTONE_TWO_LEVELS)
#define TOUCHSTONE_TWO_LEVELS
#define TOUCHSTONE_DESCENT_HAS_TWO_LEVELS
#endif

namespace touchstone {
namespace {

// Of a pose that is nearly rigid.
constexpr double greatest_skew = 1e-3;
constexpr double length_of_turn = greatest_row_of_turn * (1 + greatest_skew);

#define TOUCHSTONE_TARGET_INCLUDE "algorithms/kernels/bvh/wide_descent.inl"
#include "algorithms/kernels/simd/foreach_target.inl"

using SeeBoxes = unsigned (*)(const WideNode&, const BoxView*, float, NodeBoxes&);
SeeBoxes seeing() { return isa() == Isa::baseline ? baseline::see_node : avx2::see_node; }

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

double slack_of(double far, double error) {
  return 64 * 0x1p-24 * far + 4 * error + std::numeric_limits<float>::min();
}

double length_of(const Mat3d& turn) { return turn.cwiseAbs().rowwise().sum().maxCoeff(); }

// `length` bounds the sum of magnitudes of each row of the second map, and `far` coordinates of a in the frame.
DescentFrame frame_of(const CommonFrame& frame, double far, double length, double reach_b) {
  far += length * reach_b + frame.b.translation.cwiseAbs().maxCoeff();
  return {.b = view_of(frame.b, slack_of(far, frame.error)),
          .a = frame.is_of_a ? BoxView{} : view_of(frame.a, 0),
          .moves_a = !frame.is_of_a};
}

}  // namespace

DescentFrame descent_frame(const CommonFrame& frame, double reach_a, double reach_b) {
  const double far = frame.is_of_a ? reach_a
                                   : length_of(frame.a.rotation) * reach_a +
                                         frame.a.translation.cwiseAbs().maxCoeff();
  return frame_of(frame, far, length_of(frame.b.rotation), reach_b);
}

DescentFrames::DescentFrames(const CommonFrame& frame, double reach_a, double reach_b) {
  const Mat3d& turn = frame.b.rotation;
  const double skew = frame.is_of_a ? skew_of(turn) : 1;
  if (!(skew < greatest_skew)) {
    frames_[0] = descent_frame(frame, reach_a, reach_b);
    return;
  }
  frames_[0] = frame_of(frame, reach_a, length_of_turn, reach_b);
  Pose back;
  back.rotation = turn.transpose();
  back.translation = -(back.rotation * frame.b.translation);
  const double far = length_of_turn * reach_a + back.translation.cwiseAbs().maxCoeff() + reach_b;
  const double slack = slack_of(far, 2 * frame.error) + 2 * skew * reach_b;
  frames_[1] = {.b = {}, .a = view_of(back, 0), .moves_a = true, .moves_b = false};
  frames_[1].b.slack = round_up(slack);
  count_ = 2;
}

unsigned see_boxes(const WideNode& node, const BoxView* view, float slack, NodeBoxes& seen) {
  return seeing()(node, view, slack, seen);
}

bool WideDescent::run(const WideBvh& a, const WideBvh& b, std::span<const DescentFrame> frames,
                      Visit visit, void* context) {
  if (a.nodes.empty() || b.nodes.empty()) return true;
  const auto meet = isa() == Isa::baseline ? baseline::meeting_children : avx2::meeting_children;
  std::array<std::uint8_t, WideNode::fan> meeting;
  open_.assign(1, {0, 0, 0xff, 0xff});
  while (!open_.empty()) {
    const Open now = open_.back();
    open_.pop_back();
    const WideNode& node_a = a.nodes[now.node_a];
    const WideNode& node_b = b.nodes[now.node_b];
    unsigned lanes_b = meet(node_a, now.lanes_a, node_b, now.lanes_b, frames, meeting);
    for (; lanes_b != 0; lanes_b &= lanes_b - 1) {
      const auto j = static_cast<std::size_t>(std::countr_zero(lanes_b));
      const std::int32_t child_b = node_b.child[j];
      const bool leaf_b = WideNode::is_leaf(child_b);
      for (unsigned lanes_a = meeting[j]; lanes_a != 0; lanes_a &= lanes_a - 1) {
        const auto i = static_cast<std::size_t>(std::countr_zero(lanes_a));
        const std::int32_t child_a = node_a.child[i];
        const bool leaf_a = WideNode::is_leaf(child_a);
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
