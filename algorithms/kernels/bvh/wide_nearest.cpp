// The nearest pairs of leaves, depth first after a first descent.
//
// Gaps along the axes are below the true ones, because the boxes are grown by the view's slack, which has
// room for ends that are rounded twice more. The root of the sum of their squares is off by less than 8
// parts of 2^24, which the factor takes away.
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
  decltype(&baseline::raise_by_boxes) by_boxes;
  decltype(&baseline::bounds_below) below;
};
NearestLoops nearest_loops() {
  if (isa() == Isa::baseline) return {baseline::raise_by_boxes, baseline::bounds_below};
  return {avx2::raise_by_boxes, avx2::bounds_below};
}

// Two nodes in one of the frames.
struct SeenPair {
  NodeBoxes a, b;
};

}  // namespace

struct WideNearest::Search {
  const WideBvh &a, &b;
  std::span<const NearestFrame> frames;
  Visit visit;
  Measure measure;
  void* context;
  std::array<AlongCache, 2>& cache;
  std::uint64_t turns_before;
  NearestLoops loops = nearest_loops();
  NearestKnown known = {std::numeric_limits<double>::infinity(), nullptr, 0};
  float upper = std::numeric_limits<float>::infinity();  // at least what is known
  // Of the nodes that were last seen.
  static constexpr std::size_t most_frames = 2;
  std::array<SeenPair, most_frames> seen{};
  const Along *along_a = nullptr, *along_b = nullptr;  // if there is a frame along the way
  unsigned lanes_a = 0, lanes_b = 0;

  // Returns false if the nodes are surely as far apart as what is known.
  bool see(const Open& now) {
    const WideNode &node_a = a.nodes[now.a], &node_b = b.nodes[now.b];
    lanes_a = now.lanes_a;
    lanes_b = now.lanes_b;
    if (known.along != nullptr) {
      along_a = &seen_along(now.a, false);
      along_b = &seen_along(now.b, true);
      if (are_far(*along_a, *along_b)) return false;
    }
    for (std::size_t f = 0; f < frames.size(); ++f) {
      const NearestFrame& in = frames[f];
      const BoxView* first = in.frame.moves_a ? &in.frame.a : nullptr;
      const BoxView* second = &in.frame.b;
      const float slack = in.frame.b.slack;
      lanes_a &= see_boxes(node_a, in.is_of_b ? second : first, in.is_of_b ? slack : 0, seen[f].a);
      lanes_b &= see_boxes(node_b, in.is_of_b ? first : second, in.is_of_b ? 0 : slack, seen[f].b);
    }
    return true;
  }

  const Along& seen_along(std::uint32_t number, bool of_b) {
    Along& seen_now = cache[of_b][number % std::tuple_size_v<AlongCache>];
    const std::uint64_t turn = turns_before + known.turns;
    if (seen_now.turn == turn && seen_now.node == number) return seen_now;
    seen_now.turn = turn;
    seen_now.node = number;
    const WideNode& node = (of_b ? b : a).nodes[number];
    const float slack = of_b ? known.along->b.slack : 0;
    NodeBoxes& boxes = seen_now.boxes;
    seen_now.lanes = see_boxes(node, of_b ? &known.along->b : &known.along->a, slack, boxes);
    if (measure != nullptr) {
      for (unsigned bits = seen_now.lanes; bits != 0; bits &= bits - 1) {
        const auto i = static_cast<std::size_t>(std::countr_zero(bits));
        if (!WideNode::is_leaf(node.child[i])) continue;
        const LeafBox box = measure(context, of_b, WideNode::leaf(node.child[i]));
        for (std::size_t k = 0; k < 3; ++k) {
          boxes.centre[k][i] = box.centre[k];
          boxes.half[k][i] = box.half[k] + slack;
        }
      }
    }
    for (std::size_t k = 0; k < 3; ++k) {
      float low = std::numeric_limits<float>::infinity(), high = -low, nothing = 0;
      for (unsigned bits = seen_now.lanes; bits != 0; bits &= bits - 1) {
        const auto i = static_cast<std::size_t>(std::countr_zero(bits));
        const float centre = boxes.centre[k][i], half = boxes.half[k][i];
        low = std::min(low, centre - half);
        high = std::max(high, centre + half);
        nothing += centre - centre;  // NaN if the box is boundless
      }
      seen_now.low[k] = low + nothing;
      seen_now.high[k] = high + nothing;
    }
    return seen_now;
  }

  bool are_far(const Along& in_a, const Along& in_b) const {
    float sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const float after = in_b.low[k] - in_a.high[k], before = in_a.low[k] - in_b.high[k];
      const float gap = after > before ? after : before;
      if (gap > 0) sum += gap * gap;
    }
    // Squares end where floats do, and lose their precision before.
    return sum > 1e-30F && sum <= std::numeric_limits<float>::max() &&
           std::sqrt(sum) * certain >= upper;
  }

  // Bounds on the distances of child i of a and the children of b; returns the bits of those below
  // `upper`.
  unsigned bounds(std::size_t i, std::array<float, fan>& bound) const {
    bound.fill(0);
    for (std::size_t f = 0; f < frames.size(); ++f) {
      loops.by_boxes(seen[f].a, i, seen[f].b, frames[f].factor * certain, bound);
    }
    if (known.along != nullptr) loops.by_boxes(along_a->boxes, i, along_b->boxes, certain, bound);
    return loops.below(upper, bound) & lanes_b;
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
  }

  // To a pair of leaves by the nearest pair of children each time: that with the least bound and near
  // centres. Their weight is a guess: it decides where the search begins, and no answer.
  void descend(Open now) {
    while (!now.is_leaf) {
      if (!see(now)) return;
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
    if (!see(now)) return;
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
};

void WideNearest::run(const WideBvh& a, const WideBvh& b, std::span<const NearestFrame> frames,
                      Visit visit, Measure measure, void* context) {
  if (a.nodes.empty() || b.nodes.empty()) return;
  if (along_ == nullptr) along_ = std::make_unique<std::array<AlongCache, 2>>();
  Search search{a, b, frames, visit, measure, context, *along_, turns_};
  const Open all = {0, false, 0xff, 0xff, 0, 0};
  search.descend(all);
  open_.assign(1, all);
  while (!open_.empty()) {
    const Open now = open_.back();
    open_.pop_back();
    if (now.bound >= search.known.distance) continue;
    if (now.is_leaf) {
      search.visit_leaves(now);
    } else {
      search.expand(now, open_);
    }
  }
  turns_ += search.known.turns;
}

}  // namespace touchstone

#if defined(TOUCHSTONE_NEAREST_HAS_TWO_LEVELS)
#undef TOUCHSTONE_TWO_LEVELS
#undef TOUCHSTONE_NEAREST_HAS_TWO_LEVELS
#endif
