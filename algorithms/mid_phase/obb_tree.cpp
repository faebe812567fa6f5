// OBB tree: trees of two oriented boxes a node, descended together.
// Paper:   Gottschalk, Lin, Manocha, "OBBTree: a hierarchical structure for rapid interference
//          detection", SIGGRAPH 1996.
// Steps:   1. Split the parts at the mean of their centres (kernels/bvh/binary_tree).
//          2. A node's box lies along the principal axes of its parts' corners.
//          3. Descend both trees: fifteen axes tell whether two boxes are apart; split the larger of two
//             that are not.
// Departs: the parts are boxes, so that the axes are those of their corners in place of those of their
//          hull. A part's own box is along the body's axes. The axes are tested as they come out in the
//          common frame, without the products that Gottschalk saves, so that poses need be no rotations.
// Fails:   costs a fitting of each node; nodes with boundless parts are not dropped.
// Cost:    O(n log n) build and refit, about 320 bytes a part.
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "algorithms/kernels/bvh/volume_trees.h"

namespace touchstone {
namespace {

struct OrientedBox {
  Mat3d axes = Mat3d::Identity();  // columns; in body coordinates
  Vec3d centre = Vec3d::Zero();
  Vec3d half = Vec3d::Zero();  // along the axes (metres), grown by a bound on the rounding
  bool is_empty = true, is_boundless = false;
};

// Calls `visit` with the eight corners of each of the boxes that is not empty.
template <class Visit>
void for_each_corner(std::span<const Aabb> boxes, std::span<const std::uint32_t> parts,
                     const Visit& visit) {
  for (const std::uint32_t part : parts) {
    const Aabb& box = boxes[part];
    if (box.is_empty()) continue;
    for (unsigned corner = 0; corner < 8; ++corner) {
      const auto at = [&](unsigned k) { return (corner >> k & 1 ? box.max : box.min)[k]; };
      visit(Vec3d(at(0), at(1), at(2)));
    }
  }
}

Mat3d principal_axes(std::span<const Aabb> boxes, std::span<const std::uint32_t> parts) {
  Vec3d mean = Vec3d::Zero();
  double count = 0;
  for_each_corner(boxes, parts, [&](const Vec3d& corner) {
    mean += corner;
    ++count;
  });
  if (!(count > 0) || !mean.allFinite()) return Mat3d::Identity();
  mean /= count;
  Mat3d spread = Mat3d::Zero();
  for_each_corner(boxes, parts, [&](const Vec3d& corner) {
    spread += (corner - mean) * (corner - mean).transpose();
  });
  const double scale = spread.trace();
  if (!(scale > 0) || !std::isfinite(scale)) return Mat3d::Identity();
  return Eigen::SelfAdjointEigenSolver<Mat3d>(spread / scale).eigenvectors();
}

// Puts the box around the parts, along its axes.
void enclose(std::span<const Aabb> boxes, std::span<const std::uint32_t> parts, double reach,
             OrientedBox& box) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  Vec3d low = Vec3d::Constant(inf), high = -low;
  box.is_empty = true;
  box.is_boundless = false;
  for_each_corner(boxes, parts, [&](const Vec3d& corner) {
    box.is_empty = false;
    if (!corner.allFinite()) box.is_boundless = true;
    const Vec3d along = box.axes.transpose() * corner;
    low = low.cwiseMin(along);
    high = high.cwiseMax(along);
  });
  if (box.is_empty || box.is_boundless) return;
  box.centre = box.axes * ((low + high) / 2);
  // The axes are orthonormal to some 1e-15, and what is along them is rounded by as much.
  box.half = ((high - low) / 2).array() + 0x1p-44 * reach;
}

class ObbTree : public VolumeTree<OrientedBox> {
 public:
  explicit ObbTree(std::span<const Aabb> parts) : VolumeTree(parts) {
    for (std::size_t n = 0; n < volumes_.size(); ++n) {
      if (!tree_.nodes[n].is_leaf()) volumes_[n].axes = principal_axes(parts, tree_.parts(n));
    }
    refit(parts);
  }

  // The axes stay as they are.
  void refit(std::span<const Aabb> parts) {
    reach_ = reach_of(parts);
    for (std::size_t n = 0; n < volumes_.size(); ++n) {
      enclose(parts, tree_.parts(n), reach_, volumes_[n]);
    }
  }
};

// A box in the frame: its centre and its half edges, which form any parallelepiped.
struct PlacedObb {
  Vec3d centre;
  Mat3d edges;

  PlacedObb(const OrientedBox& box, const Pose& pose)
      : centre(pose(box.centre)), edges(pose.rotation * box.axes * box.half.asDiagonal()) {}
};

// True if the boxes are more than `slack` apart along the axis, which may have any length.
bool parts(const Vec3d& axis, const PlacedObb& a, const PlacedObb& b, double slack) {
  const double between = std::abs(axis.dot(b.centre - a.centre));
  const double reach =
      (a.edges.transpose() * axis).lpNorm<1>() + (b.edges.transpose() * axis).lpNorm<1>();
  return between > reach + slack * axis.lpNorm<1>();
}

bool are_apart(const PlacedObb& a, const PlacedObb& b, double slack) {
  for (int i = 0; i < 3; ++i) {
    const int next = (i + 1) % 3, last = (i + 2) % 3;
    // The normals of faces, also where an edge has no length.
    if (parts(a.edges.col(next).cross(a.edges.col(last)), a, b, slack) ||
        parts(b.edges.col(next).cross(b.edges.col(last)), a, b, slack)) {
      return true;
    }
  }
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (parts(a.edges.col(i).cross(b.edges.col(j)), a, b, slack)) return true;
    }
  }
  return false;
}

struct ObbComparison : PlacedTrees<ObbTree> {
  bool apart(std::uint32_t i, std::uint32_t j) const {
    const OrientedBox &box_a = a.volume(i), &box_b = b.volume(j);
    if (box_a.is_empty || box_b.is_empty) return true;
    if (box_a.is_boundless || box_b.is_boundless) return false;
    return are_apart(PlacedObb(box_a, frame.a), PlacedObb(box_b, frame.b), wide);
  }
  bool splits_first(std::uint32_t i, std::uint32_t j) const {
    const OrientedBox &box_a = a.volume(i), &box_b = b.volume(j);
    return box_a.is_boundless || (!box_b.is_boundless && !(box_a.half.sum() < box_b.half.sum()));
  }
  bool meet(std::uint32_t, std::uint32_t) const { return true; }

  double wide = 4 * slack;  // along axes that are rounded
};

using ObbTreeMidPhase = VolumeTreeMidPhase<ObbTree, ObbComparison>;

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<MidPhaseEntry> mid_phase_obb_tree() {
  return {{.info = {.name = "obb-tree",
                    .citation = "S. Gottschalk, M. C. Lin, D. Manocha, \"OBBTree: a hierarchical "
                                "structure for rapid interference detection\", SIGGRAPH 1996"},
           .make = [] { return std::make_unique<ObbTreeMidPhase>(); }}};
}

}  // namespace touchstone::entries
