// The nearest pairs of leaves, depth first after a first descent.
//
// Gaps along the axes, and along the known way, are below the true ones, because the boxes are grown by the view's slack. The
// root of the sum of their squares is off by less than 8 parts of 2^24, which the factor takes away.
#include "algorithms/kernels/bvh/wide_nearest.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "algorithms/kernels/simd/vector.h"

// A node has eight lanes, which is what the second level has.
#if !defined(TOUCHSTONE_TWO_LEVELS)
#define TOUCHSTONE_TWO_LEVELS
#define TOUCHSTONE_NEAREST_HAS_TWO_LEVELS
#endif

namespace touchstone {
namespace {

constexpr std::size_t fan = WideNode::fan;
constexpr float certain = 1 - 0x1p-20F;

#define TOUCHSTONE_TARGET_INCLUDE "algorithms/kernels/bvh/wide_nearest.inl"
#include "algorithms/kernels/simd/foreach_target.inl"

struct NearestLoops {
  decltype(&baseline::begin_of_node) begin_of;
  decltype(&baseline::raise_by_boxes) by_boxes;
  decltype(&baseline::raise_along) along;
};
NearestLoops nearest_loops() {
  if (isa() == Isa::baseline) {
    return {baseline::begin_of_node, baseline::raise_by_boxes, baseline::raise_along};
  }
  return {avx2::begin_of_node, avx2::raise_by_boxes, avx2::raise_along};
}

// The known way as the two bodies see it, in their own frames.
struct Ways {
  std::array<float, 3> in_a{}, against_a{}, in_b{};
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
    for (std::size_t k = 0; k < 3; ++k) against_a[k] = -in_a[k];
  }
};

// Two nodes in one of the frames.
struct SeenPair {
  NodeBoxes a, b;
};

}  // namespace

struct WideNearest::Search {
  const WideBvh &a, &b;
  const DescentFrame& world;
  std::span<const NearestFrame> frames;
  Visit visit;
  void* context;
  NearestLoops loops = nearest_loops();
  NearestKnown known = {std::numeric_limits<double>::infinity(), {}};
  float upper = std::numeric_limits<float>::infinity();  // at least what is known
  Ways ways{};
  // Of the nodes that were last seen.
  static constexpr std::size_t most_frames = 2;
  std::array<SeenPair, most_frames> seen{};
  std::array<float, fan> against_a{}, begin_b{};
  unsigned lanes_a = 0, lanes_b = 0;

  void see(const Open& now) {
    const WideNode &node_a = a.nodes[now.a], &node_b = b.nodes[now.b];
    lanes_a = now.lanes_a;
    lanes_b = now.lanes_b;
    for (std::size_t f = 0; f < frames.size(); ++f) {
      const NearestFrame& in = frames[f];
      const BoxView* first = in.frame.moves_a ? &in.frame.a : nullptr;
      const BoxView* second = &in.frame.b;
      const float slack = in.frame.b.slack;
      lanes_a &= see_boxes(node_a, in.is_of_b ? second : first, in.is_of_b ? slack : 0, seen[f].a);
      lanes_b &= see_boxes(node_b, in.is_of_b ? first : second, in.is_of_b ? 0 : slack, seen[f].b);
    }
    loops.begin_of(node_a, ways.against_a, against_a);
    loops.begin_of(node_b, ways.in_b, begin_b);
  }

  // Bounds on the distances of child i of a and the children of b; returns the bits of those below
  // `upper`.
  unsigned bounds(std::size_t i, std::array<float, fan>& bound) const {
    bound.fill(0);
    for (std::size_t f = 0; f < frames.size(); ++f) {
      loops.by_boxes(seen[f].a, i, seen[f].b, frames[f].factor * certain, bound);
    }
    return loops.along(-against_a[i], begin_b, ways.offset - world.b.slack, certain, upper, bound) &
           lanes_b;
  }

  Open child_of(const Open& now, std::size_t i, std::size_t j, float bound) const {
    const std::int32_t child_a = a.nodes[now.a].child[i], child_b = b.nodes[now.b].child[j];
    const bool leaf_a = WideNode::is_leaf(child_a), leaf_b = WideNode::is_leaf(child_b);
    Open next = {bound,
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
    return next;
  }

  void visit_leaves(const Open& now) {
    const WideNode &in_a = a.nodes[now.a], &in_b = b.nodes[now.b];
    const auto i = static_cast<std::size_t>(std::countr_zero(now.lanes_a));
    const auto j = static_cast<std::size_t>(std::countr_zero(now.lanes_b));
    const double before = known.distance;
    known = visit(context, WideNode::leaf(in_a.child[i]), WideNode::leaf(in_b.child[j]));
    if (known.distance == before) return;
    upper = static_cast<float>(known.distance) * (1 + 0x1p-20F) + std::numeric_limits<float>::min();
    ways = Ways(world, known.way);
  }

  // To a pair of leaves by the nearest pair of children each time: that with the least bound and near
  // centres. Their weight is a guess: it decides where the search begins, and no answer.
  void descend(Open now) {
    while (!now.is_leaf) {
      see(now);
      Open best = now;
      float least = std::numeric_limits<float>::infinity();
      for (unsigned bits = lanes_a; bits != 0; bits &= bits - 1) {
        const auto i = static_cast<std::size_t>(std::countr_zero(bits));
        std::array<float, fan> bound;
        for (unsigned near = bounds(i, bound); near != 0; near &= near - 1) {
          const auto j = static_cast<std::size_t>(std::countr_zero(near));
          float square = 0;
          for (std::size_t k = 0; k < 3; ++k) {
            const float way = seen[0].b.centre[k][j] - seen[0].a.centre[k][i];
            square += way * way;
          }
          const float far = bound[j] + 0.25F * std::sqrt(square);
          if (!(far < least)) continue;
          least = far;
          best = child_of(now, i, j, bound[j]);
        }
      }
      if (!(least < std::numeric_limits<float>::infinity())) return;
      now = best;
    }
    visit_leaves(now);
  }

  // Pushes the pairs of children that may be nearer than what is known, the nearest last.
  void expand(const Open& now, std::vector<Open>& open) {
    see(now);
    const std::size_t from = open.size();
    for (unsigned bits = lanes_a; bits != 0; bits &= bits - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(bits));
      std::array<float, fan> bound;
      for (unsigned near = bounds(i, bound); near != 0; near &= near - 1) {
        const auto j = static_cast<std::size_t>(std::countr_zero(near));
        open.push_back(child_of(now, i, j, std::max(bound[j], now.bound)));
      }
    }
    std::sort(open.begin() + static_cast<std::ptrdiff_t>(from), open.end(),
              [](const Open& p, const Open& q) { return p.bound > q.bound; });
  }

  // The way may be known better than when the leaves were found.
  bool is_far(const Open& now) const {
    if (now.bound >= known.distance) return true;
    if (!now.is_leaf) return false;
    const auto i = static_cast<std::size_t>(std::countr_zero(now.lanes_a));
    const auto j = static_cast<std::size_t>(std::countr_zero(now.lanes_b));
    const float end = -begin_along(a.nodes[now.a], i, ways.against_a);
    const float gap =
        (begin_along(b.nodes[now.b], j, ways.in_b) - end + ways.offset - world.b.slack) * certain;
    return gap <= std::numeric_limits<float>::max() && gap >= known.distance;
  }

  // As begin_of_node, of one child.
  static float begin_along(const WideNode& node, std::size_t i, const std::array<float, 3>& way) {
    float sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const float low = way[k] * node.planes[k][i], high = way[k] * node.planes[3 + k][i];
      const float both = low + high;
      sum += (low < high ? low : high) + (both - both);
    }
    return sum;
  }
};

void WideNearest::run(const WideBvh& a, const WideBvh& b, const DescentFrame& world,
                      std::span<const NearestFrame> frames, Visit visit, void* context) {
  if (a.nodes.empty() || b.nodes.empty()) return;
  Search search{a, b, world, frames, visit, context};
  const Open all = {0, false, 0xff, 0xff, 0, 0};
  search.descend(all);
  open_.assign(1, all);
  while (!open_.empty()) {
    const Open now = open_.back();
    open_.pop_back();
    if (search.is_far(now)) continue;
    if (now.is_leaf) {
      search.visit_leaves(now);
    } else {
      search.expand(now, open_);
    }
  }
}

}  // namespace touchstone

#if defined(TOUCHSTONE_NEAREST_HAS_TWO_LEVELS)
#undef TOUCHSTONE_TWO_LEVELS
#undef TOUCHSTONE_NEAREST_HAS_TWO_LEVELS
#endif
