// The nearest pairs of leaves, from a heap of pairs of nodes.
//
// Gaps along the axes, and along the known way, are below the true ones, because the boxes are grown by the view's slack. The
// root of the sum of their squares is off by less than 8 parts of 2^24, which the factor takes away.
#include "algorithms/kernels/bvh/wide_nearest.h"

#include <algorithm>
#include <array>
#include <bit>
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

// The known way as the two bodies see it, in their own frames.
struct Ways {
  std::array<float, 3> in_a{}, in_b{};
  float offset = 0;  // of the frames along the way

  Ways() = default;
  Ways(const DescentFrame& frame, const std::array<float, 3>& way) {
    for (std::size_t row = 0; row < 3; ++row) {
      for (std::size_t k = 0; k < 3; ++k) {
        in_a[k] += frame.a.turn[row][k] * way[row];
        in_b[k] += frame.b.turn[row][k] * way[row];
      }
      offset += (frame.b.offset[row] - frame.a.offset[row]) * way[row];
    }
  }
};

// Where child i of the node begins along the way; NaN of a boundless box.
float begin_of(const WideNode& node, std::size_t i, const std::array<float, 3>& way) {
  float sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const float low = way[k] * node.planes[k][i], high = way[k] * node.planes[3 + k][i];
    const float both = low + high;
    sum += (low < high ? low : high) + (both - both);
  }
  return sum;
}
float end_of(const WideNode& node, std::size_t i, const std::array<float, 3>& way) {
  return -begin_of(node, i, {-way[0], -way[1], -way[2]});
}

// The gap between two ends along the way. NaN and infinity come of boundless boxes, and of what is
// beyond floats.
float gap_along(float end_a, float begin_b, const Ways& ways, float slack) {
  const float gap = (begin_b - end_a + ways.offset - slack) * certain;
  return gap <= std::numeric_limits<float>::max() ? gap : 0;
}

}  // namespace

void WideNearest::run(const WideBvh& a, const WideBvh& b, const DescentFrame& frame, Visit visit,
                      void* context) {
  if (a.nodes.empty() || b.nodes.empty()) return;
  const auto further = [](const Open& p, const Open& q) { return p.bound > q.bound; };
  NearestKnown known = {std::numeric_limits<double>::infinity(), {}};
  Seen seen_a, seen_b;
  Ways ways;
  open_.assign(1, {0, false, 0xff, 0xff, 0, 0});
  while (!open_.empty()) {
    std::ranges::pop_heap(open_, further);
    const Open now = open_.back();
    open_.pop_back();
    if (now.bound >= known.distance) return;
    if (now.is_leaf) {
      const WideNode &in_a = a.nodes[now.a], &in_b = b.nodes[now.b];
      const auto i = static_cast<std::size_t>(std::countr_zero(now.lanes_a));
      const auto j = static_cast<std::size_t>(std::countr_zero(now.lanes_b));
      // The way may be known better than when the leaves were found.
      const float gap =
          gap_along(end_of(in_a, i, ways.in_a), begin_of(in_b, j, ways.in_b), ways, frame.b.slack);
      if (gap >= known.distance) continue;
      known = visit(context, WideNode::leaf(in_a.child[i]), WideNode::leaf(in_b.child[j]));
      ways = Ways(frame, known.way);
      continue;
    }
    const WideNode &node_a = a.nodes[now.a], &node_b = b.nodes[now.b];
    see(node_a, frame.a, 0, seen_a);
    see(node_b, frame.b, frame.b.slack, seen_b);
    std::array<float, fan> begin_b;
    for (std::size_t j = 0; j < fan; ++j) begin_b[j] = begin_of(node_b, j, ways.in_b);
    for (std::size_t i = 0; i < fan; ++i) {
      const std::int32_t child_a = node_a.child[i];
      if ((now.lanes_a >> i & 1) == 0 || child_a == WideNode::no_child) continue;
      const float end_a = end_of(node_a, i, ways.in_a);
      std::array<float, fan> bound;
      bounds(seen_a, i, seen_b, bound);
      for (std::size_t j = 0; j < fan; ++j) {
        const std::int32_t child_b = node_b.child[j];
        if ((now.lanes_b >> j & 1) == 0 || child_b == WideNode::no_child) continue;
        if (bound[j] >= known.distance) continue;
        const float along = gap_along(end_a, begin_b[j], ways, frame.b.slack);
        if (along >= known.distance) continue;
        const bool leaf_a = WideNode::is_leaf(child_a), leaf_b = WideNode::is_leaf(child_b);
        Open next = {std::max({bound[j], along, now.bound}),
                     leaf_a && leaf_b,
                     static_cast<std::uint8_t>(1u << i),
                     static_cast<std::uint8_t>(1u << j),
                     now.a,
                     now.b};
        if (!leaf_a) {
          next.a = static_cast<std::uint32_t>(child_a);
          next.lanes_a = 0xff;
        }
        if (!leaf_b) {
          next.b = static_cast<std::uint32_t>(child_b);
          next.lanes_b = 0xff;
        }
        open_.push_back(next);
        std::ranges::push_heap(open_, further);
      }
    }
  }
}

}  // namespace touchstone
