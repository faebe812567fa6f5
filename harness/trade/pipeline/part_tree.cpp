// Builds and traverses the tree of a body's parts.
#include "harness/trade/pipeline/part_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "algorithms/core/bounds.h"

namespace touchstone::trade {
namespace {

// Rotations of scene files are orthonormal to at worst a thousandth; lengths across frames are no
// better than that.
constexpr double length_slack = 4e-3;
constexpr double rounding = 1e-12;  // bound of the rounding of the numbers that a test adds

Vec3d point_of(const proxies::Part& part) {
  return part.shape.kind == ShapeKind::hull ? part.pose(part.shape.hull->vertices.front())
                                            : part.pose.translation;
}

// The frame of b relative to that of a.
struct Relative {
  Relative(const Pose& a, const Pose& b) {
    const Mat3d inverse_a = a.rotation.inverse(), inverse_b = b.rotation.inverse();
    turn = inverse_a * b.rotation;
    shift = inverse_a * (b.translation - a.translation);
    back = inverse_b * a.rotation;
    size = turn.cwiseAbs();
    size_back = back.cwiseAbs();
    scale = rounding * (shift.cwiseAbs().maxCoeff() + 1e-300);
  }
  Mat3d turn, back, size, size_back;
  Vec3d shift;
  double scale;
};

// The distance of the boxes along the axes of either frame: a lower bound of the distance of their
// contents.
double gap(const PartTree::Node& a, const PartTree::Node& b, const Relative& r) {
  const Vec3d apart = r.turn * b.centre + r.shift - a.centre;
  const Vec3d along_a = (apart.cwiseAbs() - a.half - r.size * b.half).cwiseMax(0);
  const Vec3d along_b = ((r.back * apart).cwiseAbs() - r.size_back * a.half - b.half).cwiseMax(0);
  const double slack = r.scale + rounding * (a.half + b.half).maxCoeff();
  return std::max(0.0, std::max(along_a.norm(), along_b.norm()) - slack);
}

// A half-space in the frame of the tree, n.x <= offset, whose distance from a box is the gap.
struct Plane {
  Plane(const PartTree& plane, const Pose& pose_plane, const Pose& pose_tree) {
    // One affine map from x in the tree's frame to the plane's.
    const Mat3d inverse = pose_plane.rotation.inverse();
    normal = (inverse * pose_tree.rotation).transpose() * plane.normal();
    offset = plane.offset() -
             plane.normal().dot(inverse * (pose_tree.translation - pose_plane.translation));
  }
  double gap(const PartTree::Node& node) const {
    const double low = normal.dot(node.centre) - normal.cwiseAbs().dot(node.half);
    return std::max(0.0, low - offset - rounding * (std::abs(low) + std::abs(offset)));
  }
  double above(const Vec3d& point) const { return std::max(0.0, normal.dot(point) - offset); }
  Vec3d normal;
  double offset;
};

// Descends both trees while `gap` allows it, and calls visit(part of a, part of b, gap).
template <class Gap, class Wanted, class Visit>
void descend(const PartTree& a, const PartTree& b, const Gap& gap_of, const Wanted& wanted,
             const Visit& visit) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> open = {{0, 0}};
  while (!open.empty()) {
    const auto [i, j] = open.back();
    open.pop_back();
    const PartTree::Node &x = a.nodes()[i], &y = b.nodes()[j];
    const double apart = gap_of(x, y);
    if (!wanted(apart)) continue;
    if (x.is_leaf() && y.is_leaf()) {
      visit(x.right, y.right, apart);
    } else if (y.is_leaf() || (!x.is_leaf() && x.half.maxCoeff() >= y.half.maxCoeff())) {
      open.emplace_back(x.left, j);
      open.emplace_back(x.right, j);
    } else {
      open.emplace_back(i, y.left);
      open.emplace_back(i, y.right);
    }
  }
}

// Traverses with the gap that fits the two: of boxes, or of a box and a half-space on either side.
template <class Wanted, class Visit>
void descend(const PartTree& a, const Pose& pose_a, const PartTree& b, const Pose& pose_b,
             const Wanted& wanted, const Visit& visit) {
  using Node = PartTree::Node;
  if (a.is_plane() && b.is_plane()) {
    visit(0, 0, 0.0);
  } else if (a.is_plane() || b.is_plane()) {
    const Plane plane = a.is_plane() ? Plane(a, pose_a, pose_b) : Plane(b, pose_b, pose_a);
    const bool first = a.is_plane();
    descend(
        a, b, [&](const Node& x, const Node& y) { return plane.gap(first ? y : x); }, wanted,
        visit);
  } else {
    const Relative relative(pose_a, pose_b);
    descend(
        a, b, [&](const Node& x, const Node& y) { return gap(x, y, relative); }, wanted, visit);
  }
}

}  // namespace

PartTree::PartTree(std::span<const proxies::Part> parts) {
  for (const proxies::Part& part : parts) points_.push_back(point_of(part));
  if (parts.size() == 1 && parts[0].shape.kind == ShapeKind::halfspace) {
    is_plane_ = true;
    const double length = parts[0].shape.normal.norm();
    normal_ = parts[0].shape.normal / length;
    offset_ = parts[0].shape.offset / length;
    nodes_.push_back({Vec3d::Zero(), Vec3d::Zero(), Node::leaf, 0});
    return;
  }
  std::vector<Node> boxes;
  for (std::uint32_t i = 0; i < parts.size(); ++i) {
    const Aabb box = tight_box(parts[i].shape, parts[i].pose);
    Vec3d low, high;
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = static_cast<double>(box.min[static_cast<std::size_t>(axis)]);
      high[axis] = static_cast<double>(box.max[static_cast<std::size_t>(axis)]);
    }
    boxes.push_back({(low + high) / 2, (high - low) / 2, Node::leaf, i});
  }
  std::vector<std::uint32_t> order(parts.size());
  std::iota(order.begin(), order.end(), 0U);
  nodes_.reserve(2 * parts.size());
  split(order, boxes);
}

std::uint32_t PartTree::split(std::span<std::uint32_t> parts, std::span<const Node> boxes) {
  const auto place = static_cast<std::uint32_t>(nodes_.size());
  if (parts.size() == 1) {
    nodes_.push_back(boxes[parts[0]]);
    return place;
  }
  Vec3d low = Vec3d::Constant(std::numeric_limits<double>::max()), high = -low;
  Vec3d least = low, greatest = high;  // the extent of the centres
  for (const std::uint32_t part : parts) {
    const Node& box = boxes[part];
    low = low.cwiseMin(box.centre - box.half);
    high = high.cwiseMax(box.centre + box.half);
    least = least.cwiseMin(box.centre);
    greatest = greatest.cwiseMax(box.centre);
  }
  int axis = 0;
  (greatest - least).maxCoeff(&axis);
  const auto middle = parts.begin() + static_cast<std::ptrdiff_t>(parts.size() / 2);
  std::nth_element(parts.begin(), middle, parts.end(), [&](std::uint32_t x, std::uint32_t y) {
    return boxes[x].centre[axis] < boxes[y].centre[axis];
  });
  nodes_.push_back({(low + high) / 2, (high - low) / 2, 0, 0});
  const std::uint32_t left = split(parts.first(parts.size() / 2), boxes);
  const std::uint32_t right = split(parts.subspan(parts.size() / 2), boxes);
  nodes_[place].left = left;
  nodes_[place].right = right;
  return place;
}

void meeting_parts(const PartTree& a, const Pose& pose_a, const PartTree& b, const Pose& pose_b,
                   std::vector<PartPair>& pairs) {
  descend(
      a, pose_a, b, pose_b, [](double apart) { return apart <= 0; },
      [&](std::uint32_t i, std::uint32_t j, double) { pairs.emplace_back(i, j); });
}

void nearest_parts(const PartTree& a, const Pose& pose_a, const PartTree& b, const Pose& pose_b,
                   std::vector<PartPair>& pairs) {
  // The traversal is depth first: what it meets first is near, and soon excludes the rest.
  double most = std::numeric_limits<double>::infinity();
  std::vector<std::pair<double, PartPair>> found;
  const auto wanted = [&](double apart) { return apart * (1 - length_slack) <= most; };
  descend(a, pose_a, b, pose_b, wanted, [&](std::uint32_t i, std::uint32_t j, double apart) {
    double upper = (pose_a(a.point(i)) - pose_b(b.point(j))).norm();
    if (a.is_plane() && b.is_plane()) upper = std::numeric_limits<double>::infinity();
    if (a.is_plane() != b.is_plane()) {
      upper = a.is_plane() ? Plane(a, pose_a, pose_b).above(b.point(j))
                           : Plane(b, pose_b, pose_a).above(a.point(i));
      upper *= 1 + length_slack;
    }
    most = std::min(most, upper);
    found.push_back({apart, {i, j}});
  });
  for (const auto& [apart, pair] : found) {
    if (wanted(apart)) pairs.push_back(pair);
  }
}

}  // namespace touchstone::trade
