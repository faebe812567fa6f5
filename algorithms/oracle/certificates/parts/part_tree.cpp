// Trees over lists of parts, and lists whose halves are apart.
#include "algorithms/oracle/certificates/parts/part_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "algorithms/core/vec.h"

namespace touchstone::oracle {
namespace {

void halve(std::span<std::uint32_t> order, std::span<const Vec3d> centres) {
  if (order.size() < 2) return;
  Vec3d low = centres[order[0]], high = low;
  for (const std::uint32_t part : order) {
    low = low.cwiseMin(centres[part]);
    high = high.cwiseMax(centres[part]);
  }
  Eigen::Index axis = 0;
  Vec3d(high / 2 - low / 2).maxCoeff(&axis);
  const auto middle = order.begin() + static_cast<std::ptrdiff_t>(order.size() / 2);
  std::nth_element(order.begin(), middle, order.end(), [&](std::uint32_t i, std::uint32_t j) {
    return centres[i][axis] < centres[j][axis];
  });
  halve(order.first(order.size() / 2), centres);
  halve(order.subspan(order.size() / 2), centres);
}

// What is beyond doubles counts as 0.
Vec3d rounded_centre(const std::optional<RationalBox>& box) {
  Vec3d centre = Vec3d::Zero();
  if (!box) return centre;
  for (std::size_t k = 0; k < 3; ++k) {
    const double middle = mpq_class((box->low[k] + box->high[k]) / 2).get_d();
    if (std::isfinite(middle)) centre[static_cast<Eigen::Index>(k)] = middle;
  }
  return centre;
}

}  // namespace

RationalBox around(const RationalBox& a, const RationalBox& b) {
  RationalBox both = a;
  for (std::size_t k = 0; k < 3; ++k) {
    both.low[k] = std::min(both.low[k], b.low[k]);
    both.high[k] = std::max(both.high[k], b.high[k]);
  }
  return both;
}

PartTree::PartTree(std::vector<std::uint32_t> order,
                   std::span<const std::optional<RationalBox>> boxes)
    : order_(std::move(order)) {
  require(order_.size() == boxes.size(), "the order has not as many parts as the body");
  std::vector<bool> is_there(order_.size());
  for (const std::uint32_t part : order_) {
    require(part < order_.size() && !is_there[part], "the order has not each part once");
    is_there[part] = true;
  }
  if (order_.empty()) return;
  boxes_.resize(2 * order_.size() - 1);
  enclose(root(), boxes);
}

void PartTree::enclose(const PartNode& node, std::span<const std::optional<RationalBox>> boxes) {
  if (node.is_leaf()) {
    boxes_[node.number] = boxes[part(node)];
    return;
  }
  enclose(node.first_half(), boxes);
  enclose(node.second_half(), boxes);
  const auto &a = box(node.first_half()), &b = box(node.second_half());
  if (a && b) boxes_[node.number] = around(*a, *b);
}

std::vector<std::uint32_t> spatial_order(std::span<const std::optional<RationalBox>> boxes) {
  std::vector<Vec3d> centres;
  centres.reserve(boxes.size());
  for (const auto& box : boxes) centres.push_back(rounded_centre(box));
  std::vector<std::uint32_t> order(centres.size());
  std::iota(order.begin(), order.end(), 0u);
  halve(order, centres);
  return order;
}

}  // namespace touchstone::oracle
