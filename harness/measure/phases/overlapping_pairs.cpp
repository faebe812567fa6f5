// Finds overlapping boxes with a binary tree.
#include "harness/measure/phases/overlapping_pairs.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <memory>

#include "algorithms/registry.h"

namespace touchstone::measure {
namespace {

Aabb hull_of(const Aabb& a, const Aabb& b) {
  Aabb hull = a;
  for (std::size_t i = 0; i < 3; ++i) {
    hull.min[i] = std::min(a.min[i], b.min[i]);
    hull.max[i] = std::max(a.max[i], b.max[i]);
  }
  return hull;
}

// A binary tree over the boxes, split at the median centre, and traversed against itself.
class Tree {
 public:
  explicit Tree(std::span<const Aabb> boxes) {
    for (std::uint32_t id = 0; id < boxes.size(); ++id) {
      if (!boxes[id].is_empty()) items_.push_back({boxes[id], id});
    }
    if (!items_.empty()) split(0, items_.size());
  }

  std::vector<IndexPair> pairs() {
    found_.clear();
    if (!nodes_.empty()) meet(0);
    std::ranges::sort(found_);
    return std::move(found_);
  }

 private:
  struct Item {
    Aabb box;
    std::uint32_t id;
  };
  struct Node {
    Aabb box;
    std::size_t first, last;  // items
    std::size_t left, right;  // nodes; 0 in a leaf
    bool is_leaf() const { return left == 0; }
  };
  static constexpr std::size_t leaf_size = 8;

  // The centre times two.
  static double centre(const Item& item, std::size_t axis) {
    return static_cast<double>(item.box.min[axis]) + static_cast<double>(item.box.max[axis]);
  }

  std::size_t longest_axis(std::size_t first, std::size_t last) const {
    std::size_t longest = 0;
    double greatest = -1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      double low = std::numeric_limits<double>::max(), high = -low;
      for (std::size_t i = first; i < last; ++i) {
        low = std::min(low, centre(items_[i], axis));
        high = std::max(high, centre(items_[i], axis));
      }
      if (high - low > greatest) {
        greatest = high - low;
        longest = axis;
      }
    }
    return longest;
  }

  std::size_t split(std::size_t first, std::size_t last) {
    const std::size_t place = nodes_.size();
    nodes_.push_back({items_[first].box, first, last, 0, 0});
    if (last - first <= leaf_size) {
      Aabb box = items_[first].box;
      for (std::size_t i = first; i < last; ++i) box = hull_of(box, items_[i].box);
      nodes_[place].box = box;
      return place;
    }
    const std::size_t middle = first + (last - first) / 2, axis = longest_axis(first, last);
    const auto at = [&](std::size_t i) { return items_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(first), at(middle), at(last), [axis](const Item& a, const Item& b) {
      return centre(a, axis) < centre(b, axis);
    });
    const std::size_t left = split(first, middle), right = split(middle, last);
    nodes_[place].left = left;
    nodes_[place].right = right;
    nodes_[place].box = hull_of(nodes_[left].box, nodes_[right].box);
    return place;
  }

  void test(const Item& a, const Item& b) {
    if (overlap(a.box, b.box)) found_.push_back({std::min(a.id, b.id), std::max(a.id, b.id)});
  }

  void meet(std::size_t place) {
    const Node& node = nodes_[place];
    if (node.is_leaf()) {
      for (std::size_t i = node.first; i < node.last; ++i) {
        for (std::size_t j = i + 1; j < node.last; ++j) test(items_[i], items_[j]);
      }
      return;
    }
    meet(node.left);
    meet(node.right);
    cross(nodes_[node.left], nodes_[node.right]);
  }

  void cross(const Node& a, const Node& b) {
    if (!overlap(a.box, b.box)) return;
    if (a.is_leaf() && b.is_leaf()) {
      for (std::size_t i = a.first; i < a.last; ++i) {
        for (std::size_t j = b.first; j < b.last; ++j) test(items_[i], items_[j]);
      }
      return;
    }
    const bool into_a = !a.is_leaf() && (b.is_leaf() || a.last - a.first >= b.last - b.first);
    const Node& opened = into_a ? a : b;
    const Node& other = into_a ? b : a;
    cross(nodes_[opened.left], other);
    cross(nodes_[opened.right], other);
  }

  std::vector<Item> items_;
  std::vector<Node> nodes_;
  std::vector<IndexPair> found_;
};

}  // namespace

std::vector<IndexPair> overlapping_pairs(std::span<const Aabb> boxes,
                                         std::size_t most_to_test_all) {
  if (boxes.size() > most_to_test_all) return Tree(boxes).pairs();
  Executor executor(1);
  PairSink sink;
  const std::unique_ptr<BroadPhase> naive =
      registry::find<BroadPhaseEntry>("naive")->make(executor);
  naive->build(boxes);
  naive->find_pairs(sink);
  std::vector<IndexPair> pairs = sink.gather();
  std::ranges::sort(pairs);
  return pairs;
}

}  // namespace touchstone::measure
