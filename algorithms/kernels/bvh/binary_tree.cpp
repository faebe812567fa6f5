// The build of a binary tree's form.
#include "algorithms/kernels/bvh/binary_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "algorithms/core/vec.h"

namespace touchstone {
namespace {

// Twice the centre; 0 where there is none.
float centre(const Aabb& box, int axis) {
  const auto k = static_cast<std::size_t>(axis);
  const float sum = box.min[k] + box.max[k];
  return std::isfinite(sum) ? sum : 0;
}

// Adds the node of these parts, which begin at `first` in the order.
void split(BinaryTree& tree, std::span<const Aabb> boxes, std::span<std::uint32_t> parts,
           std::uint32_t first) {
  const auto number = static_cast<std::uint32_t>(tree.nodes.size());
  tree.nodes.push_back({0, first, static_cast<std::uint32_t>(parts.size())});
  if (parts.size() == 1) return;
  Vec3d mean = Vec3d::Zero(), squares = Vec3d::Zero();
  for (const std::uint32_t part : parts) {
    const Vec3d at(centre(boxes[part], 0), centre(boxes[part], 1), centre(boxes[part], 2));
    mean += at;
    squares += at.cwiseAbs2();
  }
  mean /= static_cast<double>(parts.size());
  int axis = 0;
  (squares / static_cast<double>(parts.size()) - mean.cwiseAbs2()).maxCoeff(&axis);
  const auto before = [&](std::uint32_t part) { return centre(boxes[part], axis) < mean[axis]; };
  auto middle = std::partition(parts.begin(), parts.end(), before);
  auto left = static_cast<std::size_t>(middle - parts.begin());
  // A split that takes off less than an eighth of many parts would make the tree too deep.
  if (std::min(left, parts.size() - left) < parts.size() / 8 + 1) {
    left = parts.size() / 2;
    std::nth_element(parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(left), parts.end(),
                     [&](std::uint32_t p, std::uint32_t q) {
                       return centre(boxes[p], axis) < centre(boxes[q], axis);
                     });
  }
  split(tree, boxes, parts.first(left), first);
  tree.nodes[number].right = static_cast<std::uint32_t>(tree.nodes.size());
  split(tree, boxes, parts.subspan(left), first + static_cast<std::uint32_t>(left));
}

}  // namespace

BinaryTree build_binary_tree(std::span<const Aabb> boxes) {
  BinaryTree tree;
  tree.order.resize(boxes.size());
  std::iota(tree.order.begin(), tree.order.end(), 0u);
  tree.nodes.reserve(2 * boxes.size());
  if (!boxes.empty()) split(tree, boxes, tree.order, 0);
  return tree;
}

}  // namespace touchstone
