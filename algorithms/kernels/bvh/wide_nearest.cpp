// The nearest pairs of leaves, from a heap of pairs of nodes.
//
// Gaps along the axes, and along the known way, are below the true ones, because the boxes are grown by the view's slack. The
// root of the sum of their squares is off by less than 8 parts of 2^24, which the factor takes away.
#include "algorithms/kernels/bvh/wide_nearest.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace touchstone {
namespace {

constexpr std::size_t fan = WideNode::fan;
constexpr float certain = 1 - 0x1p-20F;

struct alignas(64) Seen {
  std::array<std::array<float, fan>, 3> centre, half;
};

// The boxes of a node's children as the view moves them; NaN where they are boundless or empty.
void see(const WideNode& node, const BoxView& view, float slack, Seen& seen) {
  std::array<std::array<float, fan>, 3> centre, half;
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < fan; ++i) {
      centre[k][i] = node.planes[k][i] * 0.5F + node.planes[3 + k][i] * 0.5F;
      half[k][i] = node.planes[3 + k][i] * 0.5F - node.planes[k][i] * 0.5F;
    }
  }
  for (std::size_t row = 0; row < 3; ++row) {
    const auto &turn = view.turn[row], &spread = view.spread[row];
    for (std::size_t i = 0; i < fan; ++i) {
      seen.centre[row][i] = turn[0] * centre[0][i] + turn[1] * centre[1][i] +
                            turn[2] * centre[2][i] + view.offset[row];
      seen.half[row][i] =
          spread[0] * half[0][i] + spread[1] * half[1][i] + spread[2] * half[2][i] + slack;
    }
  }
}

// Bounds on the distances of box i of a and the boxes of b; 0 where they are not known.
void bounds(const Seen& a, std::size_t i, const Seen& b, std::array<float, fan>& bound) {
  std::array<float, fan> sum{}, widest{};
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t j = 0; j < fan; ++j) {
      const float gap = std::abs(b.centre[k][j] - a.centre[k][i]) - (b.half[k][j] + a.half[k][i]);
      const float apart = gap > 0 ? gap : 0;
      sum[j] += apart * apart;
      widest[j] = std::max(widest[j], apart);
    }
  }
  for (std::size_t j = 0; j < fan; ++j) {
    // The squares of what is above 1e19 are infinite.
    bound[j] =
        sum[j] <= std::numeric_limits<float>::max() ? std::sqrt(sum[j]) * certain : widest[j];
    if (!(bound[j] <= std::numeric_limits<float>::max())) bound[j] = 0;
  }
}

// Where the boxes end along the way, in its sense or against it.
void ends(const Seen& seen, const std::array<float, 3>& way, float sense,
          std::array<float, fan>& end) {
  end = {};
  for (std::size_t k = 0; k < 3; ++k) {
    const float reach = sense * std::abs(way[k]);
    for (std::size_t i = 0; i < fan; ++i) {
      end[i] += way[k] * seen.centre[k][i] + reach * seen.half[k][i];
    }
  }
}

}  // namespace

void WideNearest::run(const WideBvh& a, const WideBvh& b, const DescentFrame& frame, Visit visit,
                      void* context) {
  if (a.nodes.empty() || b.nodes.empty()) return;
  const auto further = [](const Open& p, const Open& q) { return p.bound > q.bound; };
  NearestKnown known = {std::numeric_limits<double>::infinity(), {}};
  Seen seen_a, seen_b;
  std::array<float, fan> end_a, end_b;
  open_.assign(1, {0, false, 0xff, 0xff, 0, 0});
  while (!open_.empty()) {
    std::ranges::pop_heap(open_, further);
    const Open now = open_.back();
    open_.pop_back();
    if (now.bound >= known.distance) return;
    if (now.is_leaf) {
      known = visit(context, now.a, now.b);
      continue;
    }
    const WideNode &node_a = a.nodes[now.a], &node_b = b.nodes[now.b];
    see(node_a, frame.a, 0, seen_a);
    see(node_b, frame.b, frame.b.slack, seen_b);
    ends(seen_a, known.way, 1, end_a);
    ends(seen_b, known.way, -1, end_b);
    for (std::size_t i = 0; i < fan; ++i) {
      const std::int32_t child_a = node_a.child[i];
      if ((now.lanes_a >> i & 1) == 0 || child_a == WideNode::no_child) continue;
      std::array<float, fan> bound;
      bounds(seen_a, i, seen_b, bound);
      for (std::size_t j = 0; j < fan; ++j) {
        const std::int32_t child_b = node_b.child[j];
        if ((now.lanes_b >> j & 1) == 0 || child_b == WideNode::no_child) continue;
        if (bound[j] >= known.distance) continue;
        const float gap = (end_b[j] - end_a[i] - frame.b.slack) * certain;
        // NaN and infinity come of boundless boxes, and of what is beyond floats.
        const float along = gap <= std::numeric_limits<float>::max() ? gap : 0;
        if (along >= known.distance) continue;
        const bool leaf_a = WideNode::is_leaf(child_a), leaf_b = WideNode::is_leaf(child_b);
        Open next = {std::max(bound[j], now.bound),
                     leaf_a && leaf_b,
                     0xff,
                     0xff,
                     static_cast<std::uint32_t>(child_a),
                     static_cast<std::uint32_t>(child_b)};
        if (next.is_leaf) {
          next.a = WideNode::leaf(child_a);
          next.b = WideNode::leaf(child_b);
        } else if (leaf_a) {
          next.a = now.a;
          next.lanes_a = static_cast<std::uint8_t>(1u << i);
        } else if (leaf_b) {
          next.b = now.b;
          next.lanes_b = static_cast<std::uint8_t>(1u << j);
        }
        open_.push_back(next);
        std::ranges::push_heap(open_, further);
      }
    }
  }
}

}  // namespace touchstone
