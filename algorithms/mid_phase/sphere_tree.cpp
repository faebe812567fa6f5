// Sphere tree: trees of two balls a node, descended together.
// Paper:   Quinlan, "Efficient distance computation between non-convex objects", ICRA 1994; Hubbard,
//          "Approximating polyhedra with spheres for time-critical collision detection", ACM TOG 15(3),
//          1996.
// Steps:   1. Split the parts at the mean of their centres (kernels/bvh/binary_tree).
//          2. A leaf's ball is that around its part's box; a node's has its centre at the middle of the
//             box of its parts, and contains all their balls.
//          3. Descend both trees: balls are apart by their centres' distance; split the larger.
//          4. Compare the boxes of two parts whose balls meet, along the frame's axes.
// Departs: the balls' centres are not searched for the least radius. Hubbard's octree of medial spheres
//          is not built.
// Fails:   balls around flat and long parts are much larger than these.
// Cost:    O(n log n) build and refit, about 112 bytes a part; turning a ball costs one point.
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "algorithms/kernels/bvh/volume_trees.h"

namespace touchstone {
namespace {

// Empty with a negative radius, boundless with an infinite one.
struct Ball {
  Vec3d centre = Vec3d::Zero();  // in body coordinates
  double radius = -1;            // metres, grown by a bound on the rounding
};

Vec3d corner(const std::array<float, 3>& at) { return {at[0], at[1], at[2]}; }

Ball ball_of(const Aabb& box) {
  if (box.is_empty()) return {};
  const Vec3d low = corner(box.min), high = corner(box.max), half = (high - low) / 2;
  if (!half.allFinite()) return {Vec3d::Zero(), std::numeric_limits<double>::infinity()};
  return {(low + high) / 2, half.norm() * (1 + 0x1p-48)};
}

class SphereTree : public VolumeTree<Ball> {
 public:
  explicit SphereTree(std::span<const Aabb> parts) : VolumeTree(parts) { refit(parts); }

  void refit(std::span<const Aabb> parts) {
    reach_ = reach_of(parts);
    parts_.assign(parts.begin(), parts.end());
    for (std::size_t n = 0; n < volumes_.size(); ++n) {
      const auto of_node = tree_.parts(n);
      volumes_[n] = of_node.size() == 1 ? ball_of(parts[of_node[0]]) : enclosing(of_node);
    }
  }

  const Aabb& box(std::uint32_t part) const { return parts_[part]; }

 private:
  // The ball around the balls of these parts.
  Ball enclosing(std::span<const std::uint32_t> parts) const {
    constexpr double inf = std::numeric_limits<double>::infinity();
    Vec3d low = Vec3d::Constant(inf), high = -low;
    for (const std::uint32_t part : parts) {
      if (parts_[part].is_empty()) continue;
      low = low.cwiseMin(corner(parts_[part].min));
      high = high.cwiseMax(corner(parts_[part].max));
    }
    Ball ball;
    ball.centre = (low + high) / 2;
    const bool bounded = ball.centre.allFinite();
    if (!bounded) ball.centre = Vec3d::Zero();
    for (const std::uint32_t part : parts) {
      const Ball inner = ball_of(parts_[part]);
      if (inner.radius < 0) continue;
      const double reach = (inner.centre - ball.centre).norm() + inner.radius;
      ball.radius = std::max(ball.radius, bounded ? reach * (1 + 0x1p-48) : inf);
    }
    return ball;
  }

  std::vector<Aabb> parts_;
};

struct BallComparison : PlacedTrees<SphereTree> {
  bool apart(std::uint32_t i, std::uint32_t j) const {
    const Ball &ball_a = a.volume(i), &ball_b = b.volume(j);
    if (ball_a.radius < 0 || ball_b.radius < 0) return true;
    const Vec3d between = frame.b(ball_b.centre) - frame.a(ball_a.centre);
    return between.norm() > ball_a.radius * stretch_a + ball_b.radius * stretch_b + wide;
  }
  bool splits_first(std::uint32_t i, std::uint32_t j) const {
    return !(a.volume(i).radius < b.volume(j).radius);
  }
  bool meet(std::uint32_t i, std::uint32_t j) const {
    return !are_apart(PlacedBox(a.box(i), frame.a), PlacedBox(b.box(j), frame.b), wide);
  }

  // How much longer a matrix makes a vector at most: the norm bounds the greatest eigenvalue.
  static double stretch(const Mat3d& m) {
    const Mat3d squares = m.transpose() * m;
    return std::sqrt(squares.cwiseAbs().rowwise().sum().maxCoeff()) * (1 + 0x1p-46);
  }

  double wide = 4 * slack;  // norms are rounded too
  double stretch_a = stretch(frame.a.rotation), stretch_b = stretch(frame.b.rotation);
};

using SphereTreeMidPhase = VolumeTreeMidPhase<SphereTree, BallComparison>;

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<MidPhaseEntry> mid_phase_sphere_tree() {
  return {{.info = {.name = "sphere-tree",
                    .citation = "S. Quinlan, \"Efficient distance computation between non-convex "
                                "objects\", ICRA 1994; P. M. Hubbard, ACM TOG 15(3), 1996"},
           .make = [] { return std::make_unique<SphereTreeMidPhase>(); }}};
}

}  // namespace touchstone::entries
