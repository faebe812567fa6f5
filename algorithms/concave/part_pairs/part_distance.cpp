// The distance of two bodies: pairs of leaves whose boxes are near, the nearest first; then their
// pairs of triangles in doubles, or of convex parts by the narrow phase.
//
// A triangle's corner is off by `error` in each coordinate, and by 4 u of the frame's greatest
// coordinate in what is computed from it; a distance or a gap along an axis by less than eight times
// both. That widens every bound.
#include "algorithms/concave/part_pairs/part_distance.h"

#include <algorithm>
#include <array>
#include <limits>

#include "algorithms/core/mesh/common_frame.h"
#include "algorithms/kernels/triangles/triangle_distance.h"

namespace touchstone {
namespace {

constexpr double none_yet = std::numeric_limits<double>::infinity();

// The frame's greatest coordinate.
double reach_in(const CommonFrame& frame, double reach_a, double reach_b) {
  const auto reach = [](const Pose& pose, double x) {
    return pose.rotation.cwiseAbs().rowwise().sum().maxCoeff() * x +
           pose.translation.cwiseAbs().maxCoeff();
  };
  return std::max(reach(frame.a, reach_a), reach(frame.b, reach_b));
}

struct Search {
  const BoundBody &a, &b;
  const WideBvh &tree_a, &tree_b;
  const PlacedConcave &placed_a, &placed_b;
  CommonFrame frame;
  double rounding;
  ConvexPairs& convex_pairs;
  double upper = none_yet, lower = none_yet;  // of what was visited
  Vec3d on_a = Vec3d::Zero(), on_b = Vec3d::Zero();
  Vec3d way = Vec3d::Zero();  // of the nearest points; a unit vector, or zero

  // A leaf's triangles in the frame, with their boxes and where they end along the way.
  struct PlacedLeaf {
    std::array<TriangleCorners, WideBvh::leaf_size> corners;
    std::array<Vec3d, WideBvh::leaf_size> low, high;
    std::array<double, WideBvh::leaf_size> first, last;

    PlacedLeaf(const BoundBody& body, std::span<const std::uint32_t> leaf, const Pose& pose,
               const Vec3d& way) {
      for (std::size_t i = 0; i < leaf.size(); ++i) {
        const TriangleCorners given = body.corners(leaf[i]);
        TriangleCorners& t = corners[i];
        for (std::size_t k = 0; k < 3; ++k) t[k] = pose(given[k]);
        low[i] = t[0].cwiseMin(t[1]).cwiseMin(t[2]);
        high[i] = t[0].cwiseMax(t[1]).cwiseMax(t[2]);
        const auto [begin, end] = std::minmax({way.dot(t[0]), way.dot(t[1]), way.dot(t[2])});
        first[i] = begin;
        last[i] = end;
      }
    }
  };

  void visit_meshes(std::span<const std::uint32_t> leaf_a, std::span<const std::uint32_t> leaf_b) {
    const PlacedLeaf in_a(a, leaf_a, frame.a, way), in_b(b, leaf_b, frame.b, way);
    for (std::size_t i = 0; i < leaf_a.size(); ++i) {
      for (std::size_t j = 0; j < leaf_b.size(); ++j) {
        // Gaps along the way, which is a unit vector up to rounding, and of the boxes.
        if ((in_b.first[j] - in_a.last[i]) * (1 - 0x1p-48) - rounding >= upper) continue;
        const Vec3d gap =
            (in_a.low[i] - in_b.high[j]).cwiseMax(in_b.low[j] - in_a.high[i]).cwiseMax(0.0);
        if (gap.norm() - rounding >= upper) continue;
        const TriangleDistance found = triangle_distance(in_a.corners[i], in_b.corners[j]);
        lower = std::min(lower, distance_bound(in_a.corners[i], in_b.corners[j], found) - rounding);
        if (found.distance + rounding < upper) {
          upper = found.distance + rounding;
          on_a = found.on_a + placed_a.pose.translation;
          on_b = found.on_b + placed_a.pose.translation;
          way = (found.on_b - found.on_a).normalized();
        }
      }
    }
  }

  void visit_parts(std::span<const std::uint32_t> leaf_a, std::span<const std::uint32_t> leaf_b) {
    std::vector<IndexPair> pairs;
    for (const std::uint32_t i : leaf_a) {
      for (const std::uint32_t j : leaf_b) pairs.push_back({i, j});
    }
    const auto outcomes =
        convex_pairs.solve(Task::distance, a, placed_a.pose, b, placed_b.pose, pairs);
    for (const Outcome& found : outcomes) {
      // Not every narrow phase has bounds.
      const bool bounded = found.lower >= 0 && found.upper >= found.lower;
      lower = std::min(lower, bounded ? found.lower : 0);
      const double reached = bounded ? found.upper : found.distance;
      if (!(reached < upper)) continue;
      upper = reached;
      on_a = found.witness_a;
      on_b = found.witness_b;
      way = found.normal.allFinite() ? found.normal : Vec3d::Zero();
    }
  }

  NearestKnown visit(std::uint32_t leaf_a, std::uint32_t leaf_b) {
    const auto parts_a = tree_a.leaf(leaf_a), parts_b = tree_b.leaf(leaf_b);
    if (a.mesh() != nullptr && b.mesh() != nullptr) {
      visit_meshes(parts_a, parts_b);
    } else {
      visit_parts(parts_a, parts_b);
    }
    const auto part = [&](int k) { return static_cast<float>(way[k]); };
    return {upper, {part(0), part(1), part(2)}};
  }
};

}  // namespace

void PartDistance::bind(std::span<const BoundBody> bodies, const MeshTrees& given) {
  bodies_ = bodies;
  given_ = &given;
  trees_.assign(bodies.size(), {});
}

// The next query builds the tree anew.
void PartDistance::refit(std::uint32_t body) { trees_[body] = {}; }

const WideBvh& PartDistance::tree_of(std::uint32_t body) {
  if (body < given_->size() && !(*given_)[body].tree.nodes.empty()) return (*given_)[body].tree;
  if (trees_[body].nodes.empty()) trees_[body] = build_wide_bvh(bodies_[body].boxes);
  return trees_[body];
}

void PartDistance::measure(const PlacedConcave& a, const PlacedConcave& b,
                           ConvexPairs& convex_pairs, Outcome& outcome) {
  const BoundBody &first = bodies_[a.body], &second = bodies_[b.body];
  const CommonFrame frame = world_frame(a.pose, first.reach, b.pose, second.reach);
  const double far = reach_in(frame, first.reach, second.reach);
  Search search{first,       second, tree_of(a.body), tree_of(b.body),
                a,           b,      frame,           8 * (frame.error + 0x1p-51 * far),
                convex_pairs};
  nearest_.run(
      search.tree_a, search.tree_b, descent_frame(frame, first.reach, second.reach),
      [](void* context, std::uint32_t leaf_a, std::uint32_t leaf_b) {
        return static_cast<Search*>(context)->visit(leaf_a, leaf_b);
      },
      &search);
  if (!(search.upper < none_yet)) return;
  outcome.upper = search.upper;
  outcome.lower = std::clamp(search.lower, 0.0, search.upper);
  outcome.witness_a = search.on_a;
  outcome.witness_b = search.on_b;
  const Vec3d way = search.on_b - search.on_a;
  outcome.distance = std::clamp(way.norm(), outcome.lower, outcome.upper);
  outcome.normal = way.normalized();
  const double width = outcome.upper - outcome.lower;
  if (!(width <= std::max(1e-9 * outcome.distance, 1e-12 * far))) {
    outcome.status = Status::not_converged;
  }
}

}  // namespace touchstone
