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

#include "algorithms/core/common_frame.h"
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
  const PlacedBody &placed_a, &placed_b;
  CommonFrame frame;
  double rounding;
  ConvexPairs& convex_pairs;
  double upper = none_yet, lower = none_yet;  // of what was visited
  Vec3d on_a = Vec3d::Zero(), on_b = Vec3d::Zero();

  // Corners of a leaf's triangles in the frame.
  static void place(const BoundBody& body, std::span<const std::uint32_t> leaf, const Pose& pose,
                    std::array<TriangleCorners, WideBvh::leaf_size>& placed) {
    for (std::size_t i = 0; i < leaf.size(); ++i) {
      const TriangleCorners corners = body.corners(leaf[i]);
      for (std::size_t k = 0; k < 3; ++k) placed[i][k] = pose(corners[k]);
    }
  }

  // A bound on the distance of the boxes around two triangles.
  static double box_distance(const TriangleCorners& p, const TriangleCorners& q) {
    const auto low = [](const TriangleCorners& t) { return t[0].cwiseMin(t[1]).cwiseMin(t[2]); };
    const auto high = [](const TriangleCorners& t) { return t[0].cwiseMax(t[1]).cwiseMax(t[2]); };
    const Vec3d gap = (low(p) - high(q)).cwiseMax(low(q) - high(p)).cwiseMax(0.0);
    return gap.norm();
  }

  void visit_meshes(std::span<const std::uint32_t> leaf_a, std::span<const std::uint32_t> leaf_b) {
    std::array<TriangleCorners, WideBvh::leaf_size> in_a, in_b;
    place(a, leaf_a, frame.a, in_a);
    place(b, leaf_b, frame.b, in_b);
    for (std::size_t i = 0; i < leaf_a.size(); ++i) {
      for (std::size_t j = 0; j < leaf_b.size(); ++j) {
        if (box_distance(in_a[i], in_b[j]) - rounding >= upper) continue;
        const TriangleDistance found = triangle_distance(in_a[i], in_b[j]);
        lower = std::min(lower, distance_bound(in_a[i], in_b[j], found) - rounding);
        if (found.distance + rounding < upper) {
          upper = found.distance + rounding;
          on_a = found.on_a + placed_a.pose.translation;
          on_b = found.on_b + placed_a.pose.translation;
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
    }
  }

  double visit(std::uint32_t leaf_a, std::uint32_t leaf_b) {
    const auto parts_a = tree_a.leaf(leaf_a), parts_b = tree_b.leaf(leaf_b);
    if (a.mesh() != nullptr && b.mesh() != nullptr) {
      visit_meshes(parts_a, parts_b);
    } else {
      visit_parts(parts_a, parts_b);
    }
    return upper;
  }
};

}  // namespace

void PartDistance::bind(std::span<const BoundBody> bodies) {
  bodies_ = bodies;
  trees_.assign(bodies.size(), {});
}

const WideBvh& PartDistance::tree_of(std::uint32_t body) {
  if (trees_[body].nodes.empty()) trees_[body] = build_wide_bvh(bodies_[body].boxes);
  return trees_[body];
}

void PartDistance::measure(const PlacedBody& a, const PlacedBody& b, ConvexPairs& convex_pairs,
                           Outcome& outcome) {
  const BoundBody &first = bodies_[a.body], &second = bodies_[b.body];
  const CommonFrame frame = world_frame(a.pose, first.reach, b.pose, second.reach);
  const double far = reach_in(frame, first.reach, second.reach);
  Search search{first,       second, tree_of(a.body), tree_of(b.body),
                a,           b,      frame,           8 * (frame.error + 0x1p-51 * far),
                convex_pairs};
  nearest_.run(
      search.tree_a, search.tree_b, descent_frame(frame, first.reach, second.reach), none_yet,
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
