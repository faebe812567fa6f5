// Part of the oracle, used by the checks of certificates and by what makes them: a binary tree over the parts
// of a body, by halving a list of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "algorithms/oracle/certificates/rationals.h"

namespace touchstone::oracle {

// A closed box in body coordinates.
struct RationalBox {
  RationalVector low, high;
};

// The least box around both.
RationalBox around(const RationalBox& a, const RationalBox& b);

// The parts from `first` to before `last` of the list. The first half of them has the box of number + 1.
struct PartNode {
  std::size_t number = 0, first = 0, last = 0;

  std::size_t size() const { return last - first; }
  bool is_leaf() const { return size() == 1; }
  PartNode first_half() const { return {number + 1, first, middle()}; }
  PartNode second_half() const { return {number + 2 * (middle() - first), middle(), last}; }

 private:
  std::size_t middle() const { return first + (last - first) / 2; }
};

class PartTree {
 public:
  // `boxes` has one box a part, and none of an unbounded one. Throws Fault unless the order has each
  // part once.
  PartTree(std::vector<std::uint32_t> order, std::span<const std::optional<RationalBox>> boxes);

  // Not of a tree without parts.
  PartNode root() const { return {0, 0, order_.size()}; }
  std::uint32_t part(const PartNode& leaf) const { return order_[leaf.first]; }
  // Around all parts of the node, if each is bounded.
  const std::optional<RationalBox>& box(const PartNode& node) const { return boxes_[node.number]; }

 private:
  void enclose(const PartNode& node, std::span<const std::optional<RationalBox>> boxes);

  std::vector<std::uint32_t> order_;
  std::vector<std::optional<RationalBox>> boxes_;
};

// An order in which parts that are near each other are mostly in one half, as doubles tell. Those without a box
// count as at the origin.
std::vector<std::uint32_t> spatial_order(std::span<const std::optional<RationalBox>> boxes);

}  // namespace touchstone::oracle
