// Part of kd-tree: building the nodes on all threads, and their bounds.
#include "algorithms/broad_phase/kd_tree/kd_nodes.h"

#include <algorithm>
#include <functional>

#include "algorithms/core/memory_usage.h"
#include "algorithms/kernels/boxes/aabb_measure.h"

namespace touchstone {
namespace {

void extend(Aabb& bounds, const Aabb& box) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    bounds.min[axis] = std::min(bounds.min[axis], box.min[axis]);
    bounds.max[axis] = std::max(bounds.max[axis], box.max[axis]);
  }
}

}  // namespace

// Splits level by level down to the cut, so that the nodes of a level are split concurrently.
void KdNodes::build(Executor& executor, std::span<const Aabb> boxes,
                    std::span<const std::uint32_t> ids) {
  const KdPart all = bodies_.start(executor, boxes, ids);
  const auto count = static_cast<std::uint32_t>(bodies_.size());
  base_ = count / 2 + 2;
  tops_.clear();
  if (count > 0) tops_.push_back({.parent = KdNode::none, .part = all});
  for (std::size_t first = 0; first < tops_.size();) {
    const std::size_t last = tops_.size();
    const auto task = [&](std::size_t i, int) {
      KdTop& top = tops_[first + i];
      top.split.own_end = top.part.last;
      if (top.part.last - top.part.first > cut_size) top.split = bodies_.split(top.part);
    };
    executor.run(last - first, std::cref(task));
    for (; first < last; ++first) {
      if (tops_[first].is_whole()) continue;
      for (int side = 0; side < 2; ++side) {
        tops_.push_back({.parent = static_cast<std::uint32_t>(first),
                         .part = tops_[first].split.children[side]});
      }
    }
  }
  nodes_.resize(std::max(nodes_.size(), base_ + tops_.size()));
  std::uint32_t child = base_ + 1;
  for (std::size_t i = 0; i < tops_.size(); ++i) {
    const KdTop& top = tops_[i];
    KdNode& node = nodes_[base_ + i];
    node = {.first = top.part.first, .own_end = top.split.own_end, .last = top.part.last};
    if (top.is_whole()) continue;
    node.left = child;
    child += 2;
  }
  const auto task = [&](std::size_t i, int) {
    const KdPart& part = tops_[i].part;
    std::uint32_t next = part.first / 2;
    if (tops_[i].is_whole()) grow(part, nodes_[base_ + i], next);
  };
  executor.run(tops_.size(), std::cref(task));
  fit(executor);
}

void KdNodes::grow(const KdPart& part, KdNode& node, std::uint32_t& next) {
  const KdSplit halves = bodies_.split(part);
  node = {.first = part.first, .own_end = halves.own_end, .last = part.last};
  if (halves.is_leaf()) return;
  const std::uint32_t left = node.left = next;
  next += 2;
  grow(halves.children[0], nodes_[left], next);
  grow(halves.children[1], nodes_[left + 1], next);
}

void KdNodes::update(Executor& executor, std::span<const Aabb> boxes) {
  bodies_.update(executor, boxes);
  fit(executor);
}

// Writes the bodies as a structure of arrays, and computes the nodes' bounds.
void KdNodes::fit(Executor& executor) {
  arrays_.resize(bodies_.size());
  const auto task = [&](std::size_t i, int) {
    tops_[i].spread = 0;
    if (tops_[i].is_whole()) fit(nodes_[base_ + i], tops_[i].spread);
  };
  executor.run(tops_.size(), std::cref(task));
  for (std::size_t i = tops_.size(); i-- > 0;) {
    if (!tops_[i].is_whole()) fit_inner(nodes_[base_ + i]);
  }
}

void KdNodes::fit(KdNode& node, double& spread) {
  if (!node.is_leaf()) {
    fit(nodes_[node.left], spread);
    fit(nodes_[node.left + 1], spread);
    return fit_inner(node);
  }
  node.bounds = fit_own(node);
  spread += sum_of_sides(node.bounds);
}

void KdNodes::fit_inner(KdNode& node) {
  node.bounds = fit_own(node);
  extend(node.bounds, nodes_[node.left].bounds);
  extend(node.bounds, nodes_[node.left + 1].bounds);
}

Aabb KdNodes::fit_own(const KdNode& node) {
  Aabb bounds = Aabb::empty();
  for (std::uint32_t i = node.first; i < node.own_end; ++i) {
    const KdBody& body = bodies_[i];
    const Aabb box{body.min, body.max};
    extend(bounds, box);
    arrays_.set(i, box, body.id);
  }
  return bounds;
}

double KdNodes::spread() const {
  double sum = 0;
  for (const KdTop& top : tops_) sum += top.spread;
  return sum;
}

std::size_t KdNodes::held_bytes() const {
  return static_cast<std::size_t>(sum_held_bytes(bodies_, arrays_, nodes_, tops_));
}

}  // namespace touchstone
