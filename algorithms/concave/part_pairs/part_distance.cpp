// The distance of two bodies: pairs of leaves whose boxes are near, the nearest first; then their
// pairs of triangles in doubles, or of convex parts by the narrow phase. Boxes are compared in the frames of
// both bodies where poses are nearly rigid, else in the world's.
//
// A triangle's corner is off by `error` in each coordinate, and by 4 u of the frame's greatest
// coordinate in what is computed from it; a distance or a gap along an axis by less than eight times
// both. That widens every bound.
#include "algorithms/concave/part_pairs/part_distance.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

#include "algorithms/core/mesh/common_frame.h"
#include "algorithms/kernels/triangles/triangle_distance.h"
#include "algorithms/kernels/triangles/triangle_gaps.h"
#include "algorithms/kernels/triangles/triangle_signs.h"

namespace touchstone {
namespace {

// The least cosine of a way and the frame's axis, which is turned again below.
constexpr double nearly_along = 0.999;
constexpr double none_yet = std::numeric_limits<double>::infinity();

// The frame's greatest coordinate.
double reach_in(const CommonFrame& frame, double reach_a, double reach_b) {
  const auto reach = [](const Pose& pose, double x) {
    return pose.rotation.cwiseAbs().rowwise().sum().maxCoeff() * x +
           pose.translation.cwiseAbs().maxCoeff();
  };
  return std::max(reach(frame.a, reach_a), reach(frame.b, reach_b));
}

// Adds the frame of a body, in which its boxes are not turned, if its pose is nearly rigid. With
// e = |R^T R - I| no vector is shortened by more than 1 - sqrt(1 - e) of it.
void add_frame(const Pose& of, double reach_of, const Pose& other, double reach_other, bool is_of_b,
               std::vector<NearestFrame>& frames) {
  const double skew = (of.rotation.transpose() * of.rotation - Mat3d::Identity()).norm();
  if (!(skew < 0.1)) return;
  const CommonFrame frame = common_frame(of, reach_of, other, reach_other);
  if (!frame.is_of_a) return;
  frames.push_back({descent_frame(frame, reach_of, reach_other), is_of_b,
                    static_cast<float>(1 - skew - 0x1p-20)});
}

// The leaf of a mesh that was last seen, in the frame of the search: one of two often comes again.
struct SeenLeaf {
  std::uint32_t leaf = std::numeric_limits<std::uint32_t>::max();
  TriangleBlock moved = {};

  const TriangleBlock& see(const MeshTree& tree, std::uint32_t number, const Pose& pose) {
    if (number != leaf) tree.blocks.move(number, pose, moved);
    leaf = number;
    return moved;
  }
};

struct Search {
  const BoundBody &a, &b;
  const MeshTree &tree_a, &tree_b;
  const PlacedConcave &placed_a, &placed_b;
  CommonFrame frame;
  double rounding;
  ConvexPairs& convex_pairs;
  double upper = none_yet, lower = none_yet;  // of what was visited
  Vec3d on_a = Vec3d::Zero(), on_b = Vec3d::Zero();
  Vec3d way = Vec3d::Zero();  // of the nearest points; a unit vector, or zero
  // The world, turned so that the way of some points that were nearest is its first axis.
  CommonFrame turned = frame;
  DescentFrame along = {};
  Mat3d axes = Mat3d::Zero();
  std::uint32_t turns = 0;
  SeenLeaf seen_a = {}, seen_b = {};

  void visit_meshes(std::uint32_t leaf_a, std::uint32_t leaf_b) {
    const auto count_a = static_cast<unsigned>(tree_a.tree.leaf(leaf_a).size());
    const auto count_b = static_cast<unsigned>(tree_b.tree.leaf(leaf_b).size());
    const TriangleBlock &in_a = seen_a.see(tree_a, leaf_a, frame.a),
                        &in_b = seen_b.see(tree_b, leaf_b, frame.b);
    const NearTriangles near = near_triangles(in_a, count_a, in_b, count_b, way, upper + rounding);
    // Pairs wait until there are eight.
    TriangleBlock wait_a, wait_b;
    std::size_t waiting = 0;
    for (std::size_t i = 0; i < count_a; ++i) {
      for (unsigned bits = near[i]; bits != 0; bits &= bits - 1) {
        const auto j = static_cast<std::size_t>(std::countr_zero(bits));
        for (std::size_t row = 0; row < wait_a.at.size(); ++row) {
          wait_a.at[row][waiting] = in_a.at[row][i];
          wait_b.at[row][waiting] = in_b.at[row][j];
        }
        if (++waiting < TriangleBlock::size) continue;
        compare(wait_a, wait_b, waiting);
        waiting = 0;
      }
    }
    if (waiting > 0) compare(wait_a, wait_b, waiting);
  }

  // Measures the pairs in the lanes whose gaps leave them near, the nearest first.
  void compare(TriangleBlock& in_a, TriangleBlock& in_b, std::size_t count) {
    for (std::size_t row = 0; row < in_a.at.size(); ++row) {
      for (std::size_t lane = count; lane < TriangleBlock::size; ++lane) {
        in_a.at[row][lane] = in_a.at[row][0];
        in_b.at[row][lane] = in_b.at[row][0];
      }
    }
    std::array<double, TriangleBlock::size> gap;
    gaps_of_pairs(in_a, in_b, gap);
    for (unsigned left = (1u << count) - 1; left != 0;) {
      auto nearest = static_cast<std::size_t>(std::countr_zero(left));
      for (unsigned bits = left; bits != 0; bits &= bits - 1) {
        const auto lane = static_cast<std::size_t>(std::countr_zero(bits));
        // NaN comes first.
        if (!(gap[nearest] <= gap[lane])) nearest = lane;
      }
      if (gap[nearest] * (1 - 0x1p-48) - rounding >= upper) return;
      left &= ~(1u << nearest);
      compare(corners_of(in_a, nearest), corners_of(in_b, nearest));
    }
  }

  static TriangleCorners corners_of(const TriangleBlock& block, std::size_t lane) {
    return {block.corner(lane, 0), block.corner(lane, 1), block.corner(lane, 2)};
  }

  void compare(const TriangleCorners& in_a, const TriangleCorners& in_b) {
    const TriangleDistance found = triangle_distance(in_a, in_b);
    lower = std::min(lower, distance_bound(in_a, in_b, found) - rounding);
    if (!(found.distance + rounding < upper)) return;
    upper = found.distance + rounding;
    on_a = found.on_a + placed_a.pose.translation;
    on_b = found.on_b + placed_a.pose.translation;
    way = (found.on_b - found.on_a).normalized();
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
    if (a.mesh() != nullptr && b.mesh() != nullptr) {
      visit_meshes(leaf_a, leaf_b);
    } else {
      visit_parts(tree_a.tree.leaf(leaf_a), tree_b.tree.leaf(leaf_b));
    }
    turn();
    return {upper, turns > 0 ? &along : nullptr, turns};
  }

  // Turns the frame along the way unless it nearly is.
  void turn() {
    if (!(way.squaredNorm() > 0.5)) return;
    if (turns > 0 && way.dot(axes.row(0)) > nearly_along) return;
    const Vec3d across = way.unitOrthogonal();
    axes << way.transpose(), across.transpose(), way.cross(across).transpose();
    turned.a.rotation = axes * frame.a.rotation;
    turned.b.rotation = axes * frame.b.rotation;
    turned.b.translation = axes * frame.b.translation;
    turned.error = 2 * frame.error;  // a turn makes a coordinate of three
    along = descent_frame(turned, a.reach, b.reach);
    ++turns;
  }

  LeafBox measure(bool of_b, std::uint32_t leaf) const {
    const Pose& pose = of_b ? turned.b : turned.a;
    const BlockBox ends = (of_b ? tree_b : tree_a).blocks.with(leaf, [&](const auto& block) {
      return box_along(block, pose.rotation);
    });
    LeafBox box;
    for (std::size_t k = 0; k < 3; ++k) {
      const double middle = (ends.low[k] + ends.high[k]) / 2;
      box.centre[k] = static_cast<float>(middle + pose.translation[static_cast<int>(k)]);
      box.half[k] = static_cast<float>((ends.high[k] - ends.low[k]) / 2);
    }
    return box;
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

const MeshTree& PartDistance::tree_of(std::uint32_t body) {
  if (body < given_->size() && !(*given_)[body].tree.nodes.empty()) return (*given_)[body];
  MeshTree& made = trees_[body];
  if (made.tree.nodes.empty()) {
    if (bodies_[body].mesh() != nullptr) {
      made = mesh_tree(bodies_[body]);
    } else {
      made.tree = build_wide_bvh(bodies_[body].boxes);
    }
  }
  return made;
}

void PartDistance::measure(const PlacedConcave& a, const PlacedConcave& b,
                           ConvexPairs& convex_pairs, Outcome& outcome) {
  const BoundBody &first = bodies_[a.body], &second = bodies_[b.body];
  const CommonFrame frame = world_frame(a.pose, first.reach, b.pose, second.reach);
  const double far = reach_in(frame, first.reach, second.reach);
  Search search{first,       second, tree_of(a.body), tree_of(b.body),
                a,           b,      frame,           8 * (frame.error + 0x1p-51 * far),
                convex_pairs};
  std::vector<NearestFrame> frames;
  add_frame(a.pose, first.reach, b.pose, second.reach, false, frames);
  add_frame(b.pose, second.reach, a.pose, first.reach, true, frames);
  if (frames.empty()) {
    frames.push_back({descent_frame(frame, first.reach, second.reach), false, 1});
  }
  const bool both_are_meshes = first.mesh() != nullptr && second.mesh() != nullptr;
  nearest_.run(
      search.tree_a.tree, search.tree_b.tree, frames,
      [](void* context, std::uint32_t leaf_a, std::uint32_t leaf_b) {
        return static_cast<Search*>(context)->visit(leaf_a, leaf_b);
      },
      both_are_meshes
          ? [](void* context, bool of_b,
               std::uint32_t leaf) { return static_cast<Search*>(context)->measure(of_b, leaf); }
          : WideNearest::Measure{nullptr},
      &search);
  if (!(search.upper < none_yet)) {
    // Squares are beyond the range of doubles, unless a body has no parts.
    const bool both = first.given->part_count() > 0 && second.given->part_count() > 0;
    if (both) outcome.status = Status::not_converged;
    return;
  }
  outcome.upper = search.upper;
  outcome.lower = std::clamp(search.lower, 0.0, search.upper);
  outcome.witness_a = search.on_a;
  outcome.witness_b = search.on_b;
  const Vec3d way = search.on_b - search.on_a;
  outcome.distance = std::clamp(way.norm(), outcome.lower, outcome.upper);
  outcome.normal = way.normalized();
  // The squares of shorter distances have lost digits.
  constexpr double shortest = 0x1p-480;
  if (!(outcome.upper > shortest)) {
    outcome.lower = 0;
    outcome.upper = shortest;
  }
  const double width = outcome.upper - outcome.lower;
  // The unit of a narrow phase is at most that.
  const double allowed = 4 * tolerance_ * (first.reach + second.reach + outcome.distance);
  if (!(width <= std::max({1e-9 * outcome.distance, 1e-12 * far, allowed}))) {
    outcome.status = Status::not_converged;
  }
}

}  // namespace touchstone
