// Part of dynamic-bvh: the bulk load of a Bvh16 and its searches.
#include "algorithms/broad_phase/dynamic_bvh/bvh16.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "algorithms/broad_phase/dynamic_bvh/surface_area.h"
#include "algorithms/core/executor/parallel_blocks.h"
#include "algorithms/core/memory_usage.h"
#include "algorithms/kernels/boxes/aabb_measure.h"
#include "algorithms/kernels/boxes/aabb_simd.h"
#include "algorithms/kernels/boxes/group_scan.h"

namespace touchstone {
namespace {

using aabb_simd::Columns;
using aabb_simd::columns_of;

#define TOUCHSTONE_TARGET_NAMESPACE aabb_simd
#define TOUCHSTONE_TARGET_INCLUDE "algorithms/broad_phase/dynamic_bvh/bvh16.inl"
#include "algorithms/kernels/simd/foreach_target.inl"

auto descend_of_level() {
  switch (isa()) {
    case Isa::avx512: return avx512::descend;
    case Isa::avx2: return avx2::descend;
    default: return baseline::descend;
  }
}
auto bounds16_of_level() {
  switch (isa()) {
    case Isa::avx512: return avx512::bounds16;
    case Isa::avx2: return avx2::bounds16;
    default: return baseline::bounds16;
  }
}
auto surfaces16_of_level() {
  switch (isa()) {
    case Isa::avx512: return avx512::surfaces16;
    case Isa::avx2: return avx2::surfaces16;
    default: return baseline::surfaces16;
  }
}

}  // namespace

// --- in bulk ---

void Bvh16::start(std::size_t bodies, std::size_t id_count, bool is_to_change) {
  bodies_ = bodies;
  leaves_ = std::max<std::size_t>(1, block_count(bodies, fan));
  std::size_t height = 0;
  begins_[0] = 0;
  begins_[1] = leaves_;
  for (std::size_t count = leaves_; count > 1; ++height) {
    count = block_count(count, fan);
    begins_[height + 2] = begins_[height + 1] + count;
  }
  node_count_ = begins_[height + 1];
  root_ = node_count_ - 1;
  free_nodes_.clear();
  marked_.clear();
  worn_.clear();
  // Loaded nodes are full, and are split where bodies come.
  make_node_capacity(node_count_ + (is_to_change ? node_count_ / 2 : 0));
  is_to_change_ = is_to_change;
  for (std::size_t h = 0; h <= height; ++h) {
    std::fill(height_of_.begin() + static_cast<std::ptrdiff_t>(begins_[h]),
              height_of_.begin() + static_cast<std::ptrdiff_t>(begins_[h + 1]),
              static_cast<std::uint8_t>(h));
  }
  place_of_.resize(id_count);
}

void Bvh16::load(Executor& executor) {
  for (std::size_t place = bodies_; place < leaves_ * fan; ++place) {
    boxes_.set(place, Aabb::empty(), nobody);
  }
  for (std::size_t height = 0; begins_[height + 1] < node_count_; ++height) {
    const std::size_t below = begins_[height];
    const std::size_t count = begins_[height + 1] - below;
    const std::size_t above = begins_[height + 1] * fan;
    for_each_block(executor, count, 1024, [&](std::size_t, std::size_t first, std::size_t last) {
      const auto bounds = bounds16_of_level();
      const Columns columns = columns_of(boxes_);
      for (std::size_t i = first; i < last; ++i) {
        const std::size_t node = below + i;
        boxes_.set(above + i, bounds(columns, node * fan), static_cast<std::uint32_t>(node));
        parent_of_[node] = static_cast<std::uint32_t>(above + i);
      }
    });
    const std::size_t end = begins_[height + 2] * fan;
    for (std::size_t i = above + count; i < end; ++i) boxes_.set(i, Aabb::empty(), nobody);
  }
  if (!is_to_change_) return;
  std::ranges::fill(mark_of_, Mark::none);
  for (std::size_t node = leaves_; node < node_count_; ++node) cost_of_[node] = cost(node);
}

void Bvh16::make_node_capacity(std::size_t nodes) {
  if (nodes <= node_capacity_) return;
  const bool is_first = node_capacity_ == 0;
  node_capacity_ = nodes + (is_first ? 0 : nodes / 16 + 4);
  boxes_.grow(node_capacity_ * fan);
  for (auto* const items : {&parent_of_, &free_nodes_, &marked_}) items->reserve(node_capacity_);
  height_of_.reserve(node_capacity_);
  mark_of_.reserve(node_capacity_);
  cost_of_.reserve(node_capacity_);
  parent_of_.resize(node_capacity_);
  height_of_.resize(node_capacity_);
  mark_of_.resize(node_capacity_);
  cost_of_.resize(node_capacity_);
}

Aabb Bvh16::box_at(std::size_t place) const {
  Aabb box;
  for (int axis = 0; axis < 3; ++axis) {
    box.min[static_cast<std::size_t>(axis)] = boxes_.min(axis)[place];
    box.max[static_cast<std::size_t>(axis)] = boxes_.max(axis)[place];
  }
  return box;
}

Aabb Bvh16::bounds_of_node(std::size_t node) const {
  return bounds16_of_level()(columns_of(boxes_), node * fan);
}

IndexRange Bvh16::places_of(std::size_t leaf) const {
  return {leaf * fan, std::min(leaf * fan + fan, bodies_)};
}

Aabb Bvh16::bounds_of_leaf(std::size_t leaf) const {
  return leaf == root_ ? bounds_of(boxes_, places_of(leaf)) : box_at(parent_of_[leaf]);
}

double Bvh16::spread() const {
  double sum = 0;
  for (std::size_t leaf = 0; leaf < leaves_; ++leaf) sum += sum_of_sides(bounds_of_leaf(leaf));
  return sum;
}

// --- searches ---

void Bvh16::make_room(Bvh16Scratch& scratch) const {
  // Whole vectors are written, so there is room for one more.
  const std::size_t room = node_capacity_ + fan;
  if (scratch.nodes.size() < room) scratch.nodes.resize(room);
  if (scratch.children.size() < room) scratch.children.resize(room);
}

void Bvh16::find_partners(std::size_t leaf, Bvh16Scratch& scratch, BroadPhaseWork& work) const {
  scratch.partners.clear();
  if (is_leaf(root_)) return;
  const auto down = descend_of_level();
  const Columns columns = columns_of(boxes_);
  const Aabb bounds = bounds_of_leaf(leaf);
  std::uint32_t* list = scratch.nodes.data();
  std::uint32_t* next = scratch.children.data();
  list[0] = static_cast<std::uint32_t>(root_);
  std::span<const std::uint32_t> nodes(list, 1);
  for (std::size_t height = height_of_[root_]; height > 0; --height) {
    work.node_visits += static_cast<std::int64_t>(nodes.size());
    for (const std::size_t node : nodes) {
      const std::size_t first = begins_[height - 1] + (node - begins_[height]) * fan;
      work.box_tests += static_cast<std::int64_t>(std::min(first + fan, begins_[height]) - first);
    }
    const std::size_t count = down(columns, bounds, nodes.data(), nodes.size(), next);
    // The nodes of one height are sorted like the leaves; those before the leaf's own are dropped.
    const std::size_t from =
        begins_[height - 1] + (leaf >> (4 * (height - 1))) + (height == 1 ? 1 : 0);
    std::size_t before = 0;
    while (before < count && next[before] < from) ++before;
    nodes = {next + before, count - before};
    std::swap(list, next);
  }
  for (const std::size_t node : nodes) {
    const IndexRange range = places_of(node);
    auto& partners = scratch.partners;
    if (!partners.empty() && partners.back().last == range.first) {
      partners.back().last = range.last;
    } else {
      partners.push_back(range);
    }
  }
}

std::span<const std::uint32_t> Bvh16::find(const Aabb& box, Bvh16Scratch& scratch) const {
  const auto down = descend_of_level();
  const Columns columns = columns_of(boxes_);
  std::uint32_t* nodes = scratch.nodes.data();
  std::uint32_t* children = scratch.children.data();
  nodes[0] = static_cast<std::uint32_t>(root_);
  std::size_t count = 1;
  for (std::size_t height = height_of_[root_]; height > 0; --height) {
    count = down(columns, box, nodes, count, children);
    std::swap(nodes, children);
  }
  const std::size_t room = (count + 1) * fan;
  if (scratch.found.size() < room) scratch.found.resize(room);
  return {scratch.found.data(), down(columns, box, nodes, count, scratch.found.data())};
}

// Returns the child whose surface grows least.
std::size_t Bvh16::best_child(std::size_t node, const Aabb& box) const {
  std::array<double, fan> growths, surfaces;
  const std::size_t first = node * fan;
  surfaces16_of_level()(columns_of(boxes_), first, box, growths.data(), surfaces.data());
  std::size_t best = nobody;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < fan; ++i) {
    if (boxes_.ids()[first + i] == nobody) continue;
    if (best == nobody) best = first + i;
    // An empty child, which all bodies have left, is the last resort.
    const bool is_empty = boxes_.min(0)[first + i] > boxes_.max(0)[first + i];
    if (!is_empty && growths[i] < least) {
      least = growths[i];
      best = first + i;
    }
  }
  return boxes_.ids()[best];
}

// The sum of the children's surfaces.
double Bvh16::cost(std::size_t node) const {
  std::array<double, fan> growths, surfaces;
  const std::size_t first = node * fan;
  surfaces16_of_level()(columns_of(boxes_), first, Aabb{}, growths.data(), surfaces.data());
  double sum = 0;
  for (std::size_t i = 0; i < fan; ++i) {
    const bool is_empty = boxes_.min(0)[first + i] > boxes_.max(0)[first + i];
    sum += is_empty ? 0 : surfaces[i];
  }
  return sum;
}

// --- pictures ---

std::vector<StructureBox> Bvh16::structure(bool with_bodies) const {
  std::vector<StructureBox> nodes;
  if (node_count_ > 0) show(root_, {bounds_of_node(root_), 0}, with_bodies, nodes);
  return nodes;
}

// Lists the node, unless it is empty, and what is below it.
void Bvh16::show(std::size_t node, const StructureBox& own, bool with_bodies,
                 std::vector<StructureBox>& nodes) const {
  if (own.box.is_empty()) return;
  nodes.push_back(own);
  for (std::size_t place = node * fan; place < node * fan + fan; ++place) {
    const StructureBox child{box_at(place), own.level + 1};
    if (!is_leaf(node)) {
      show(boxes_.ids()[place], child, with_bodies, nodes);
    } else if (with_bodies && !child.box.is_empty()) {
      nodes.push_back(child);
    }
  }
}

std::size_t Bvh16::held_bytes() const {
  return static_cast<std::size_t>(sum_held_bytes(boxes_, place_of_, parent_of_, height_of_,
                                                 cost_of_, mark_of_, marked_, worn_, free_nodes_,
                                                 entries_));
}

}  // namespace touchstone
