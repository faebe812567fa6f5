#include "algorithms/kernels/wide_tree.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "algorithms/kernels/blocks.h"
#include "algorithms/kernels/box_lanes.h"
#include "algorithms/kernels/group_scan.h"
#include "algorithms/kernels/held_bytes.h"

namespace touchstone {
namespace {

using box_lanes::Columns;
using box_lanes::columns_of;

#define TOUCHSTONE_LOOPS "algorithms/kernels/wide_tree.inl"
#include "algorithms/kernels/every_level.inl"

auto descend_of_level() {
  switch (isa()) {
    case Isa::avx512: return avx512::descend;
    case Isa::avx2: return avx2::descend;
    default: return baseline::descend;
  }
}

Aabb united(const Aabb& a, const Aabb& b) {
  Aabb sum;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    sum.min[axis] = std::min(a.min[axis], b.min[axis]);
    sum.max[axis] = std::max(a.max[axis], b.max[axis]);
  }
  return sum;
}

// A quarter of the surface, and a little of the lengths, for boxes of a point or a line. In double,
// in which no float overflows.
double surface(const Aabb& box) {
  const double x = double{box.max[0]} - box.min[0];
  const double y = double{box.max[1]} - box.min[1];
  const double z = double{box.max[2]} - box.min[2];
  return x * y + y * z + z * x + 1e-6 * (x * x + y * y + z * z);
}

}  // namespace

BoxArrays& WideTree::start(std::size_t bodies) {
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
  node_capacity_ = 2 * node_count_ + leaves_ / 15 + 4 * most_heights;
  boxes_.resize(node_capacity_ * fan);
  parent_of_.resize(node_capacity_);
  height_of_.resize(node_capacity_);
  for (std::size_t h = 0; h <= height; ++h) {
    for (std::size_t node = begins_[h]; node < begins_[h + 1]; ++node) {
      height_of_[node] = static_cast<std::uint8_t>(h);
    }
  }
  return boxes_;
}

void WideTree::load(Executor& executor, std::size_t id_count) {
  place_of_.resize(id_count);
  for (std::size_t place = bodies_; place < leaves_ * fan; ++place) {
    boxes_.set(place, Aabb::empty(), nobody);
  }
  const std::size_t placed = id_count > 0 ? bodies_ : 0;
  for_each_block(executor, placed, 8192, [&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      place_of_[boxes_.ids()[i]] = static_cast<std::uint32_t>(i);
    }
  });
  for (std::size_t height = 0; begins_[height + 1] < node_count_; ++height) {
    const std::size_t below = begins_[height];
    const std::size_t count = begins_[height + 1] - below;
    const std::size_t above = begins_[height + 1] * fan;
    for_each_block(executor, count, 1024, [&](std::size_t, std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        const std::size_t node = below + i;
        put(above + i, bounds_of(boxes_, {node * fan, node * fan + fan}),
            static_cast<std::uint32_t>(node));
      }
    });
    const std::size_t end = begins_[height + 2] * fan;
    for (std::size_t i = above + count; i < end; ++i) boxes_.set(i, Aabb::empty(), nobody);
  }
}

Aabb WideTree::box_at(std::size_t place) const {
  Aabb box;
  for (int axis = 0; axis < 3; ++axis) {
    box.min[static_cast<std::size_t>(axis)] = boxes_.min(axis)[place];
    box.max[static_cast<std::size_t>(axis)] = boxes_.max(axis)[place];
  }
  return box;
}

IndexRange WideTree::places_of(std::size_t leaf) const {
  return {leaf * fan, std::min(leaf * fan + fan, bodies_)};
}

Aabb WideTree::bounds_of_leaf(std::size_t leaf) const {
  return leaf == root_ ? bounds_of(boxes_, places_of(leaf)) : box_at(parent_of_[leaf]);
}

double WideTree::spread() const {
  double sum = 0;
  for (std::size_t leaf = 0; leaf < leaves_; ++leaf) {
    const Aabb bounds = bounds_of_leaf(leaf);
    for (std::size_t axis = 0; axis < 3; ++axis) sum += double{bounds.max[axis]} - bounds.min[axis];
  }
  return sum;
}

void WideTree::make_room(WideTreeScratch& scratch) const {
  // A vector's width more, since whole vectors are written.
  const std::size_t room = node_capacity_ * fan + fan;
  if (scratch.nodes.size() < room) scratch.nodes.resize(room);
  if (scratch.children.size() < room) scratch.children.resize(room);
}

void WideTree::find_partners(std::size_t leaf, WideTreeScratch& scratch,
                             BroadPhaseWork& work) const {
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
    // Nodes of one height are in the order of the leaves: those before the leaf's own are left out.
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

std::span<const std::uint32_t> WideTree::find(const Aabb& box, WideTreeScratch& scratch) const {
  const auto down = descend_of_level();
  const Columns columns = columns_of(boxes_);
  std::uint32_t* nodes = scratch.nodes.data();
  std::uint32_t* children = scratch.children.data();
  nodes[0] = static_cast<std::uint32_t>(root_);
  std::size_t count = 1;
  for (std::size_t height = height_of_[root_] + std::size_t{1}; height > 0; --height) {
    count = down(columns, box, nodes, count, children);
    std::swap(nodes, children);
  }
  return {nodes, count};
}

// Children of inner nodes know their parent, bodies their place.
void WideTree::put(std::size_t place, const Aabb& box, std::uint32_t child) {
  boxes_.set(place, box, child);
  if (is_leaf(place / fan)) {
    place_of_[child] = static_cast<std::uint32_t>(place);
  } else {
    parent_of_[child] = static_cast<std::uint32_t>(place);
  }
}

std::size_t WideTree::new_node(std::size_t height) {
  const std::size_t node = node_count_++;
  height_of_[node] = static_cast<std::uint8_t>(height);
  for (std::size_t place = node * fan; place < node * fan + fan; ++place) {
    boxes_.set(place, Aabb::empty(), nobody);
  }
  return node;
}

// A change splits a leaf at most. Of the nodes above, which were loaded full, each may split at the
// first split below it, and again at each eighth: halves have at least eight children.
bool WideTree::has_room_for(std::size_t changes) const {
  const std::size_t above = leaves_ / 15 + changes / 7 + 2 * most_heights;
  return node_count_ + changes + above <= node_capacity_;
}

// The child whose surface grows least.
std::size_t WideTree::best_child(std::size_t node, const Aabb& box) const {
  std::size_t best = nobody;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t place = node * fan; place < node * fan + fan; ++place) {
    if (boxes_.ids()[place] == nobody) continue;
    if (best == nobody) best = place;
    const Aabb child = box_at(place);
    if (child.is_empty()) continue;  // where all bodies have left
    const double growth = surface(united(child, box)) - surface(child);
    if (growth < least) {
      least = growth;
      best = place;
    }
  }
  return boxes_.ids()[best];
}

void WideTree::insert(std::uint32_t id, const Aabb& box) {
  std::size_t node = root_;
  while (!is_leaf(node)) node = best_child(node, box);
  add(node, box, id);
}

void WideTree::add(std::size_t node, const Aabb& box, std::uint32_t child) {
  const std::uint32_t* const first = boxes_.ids() + node * fan;
  const std::uint32_t* const free = std::find(first, first + fan, nobody);
  if (free == first + fan) return split(node, box, child);
  put(node * fan + static_cast<std::size_t>(free - first), box, child);
  fit_above(node);
}

void WideTree::split(std::size_t node, const Aabb& box, std::uint32_t child) {
  struct Entry {
    Aabb box;
    std::uint32_t child;
  };
  std::array<Entry, fan + 1> entries;
  for (std::size_t i = 0; i < fan; ++i) {
    entries[i] = {box_at(node * fan + i), boxes_.ids()[node * fan + i]};
  }
  entries[fan] = {box, child};
  // Empty children, of which the sums would not be numbers, go first.
  const auto centre = [](const Entry& entry, std::size_t axis) {
    return entry.box.is_empty() ? -std::numeric_limits<double>::infinity()
                                : double{entry.box.min[axis]} + entry.box.max[axis];
  };
  std::size_t longest = 0;
  double most = -1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const Entry& entry : entries) {
      if (entry.box.is_empty()) continue;
      low = std::min(low, centre(entry, axis));
      high = std::max(high, centre(entry, axis));
    }
    if (high - low > most) {
      most = high - low;
      longest = axis;
    }
  }
  std::ranges::sort(entries, [&](const Entry& a, const Entry& b) {
    const double at = centre(a, longest);
    const double bt = centre(b, longest);
    return at < bt || (at == bt && a.child < b.child);
  });
  const std::size_t other = new_node(height_of_[node]);
  constexpr std::size_t half = (fan + 1) / 2;
  for (std::size_t i = 0; i < fan; ++i) boxes_.set(node * fan + i, Aabb::empty(), nobody);
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const std::size_t place = i < half ? node * fan + i : other * fan + i - half;
    put(place, entries[i].box, entries[i].child);
  }
  if (node == root_) {
    root_ = new_node(height_of_[node] + std::size_t{1});
    parent_of_[node] = static_cast<std::uint32_t>(root_ * fan);
    put(root_ * fan, bounds_of(boxes_, {node * fan, node * fan + fan}),
        static_cast<std::uint32_t>(node));
  } else {
    fit_above(node);
  }
  add(parent_of_[node] / fan, bounds_of(boxes_, {other * fan, other * fan + fan}),
      static_cast<std::uint32_t>(other));
}

void WideTree::remove(std::uint32_t id) {
  const std::size_t place = place_of_[id];
  boxes_.set(place, Aabb::empty(), nobody);
  fit_above(place / fan);
}

void WideTree::move(std::uint32_t id, const Aabb& box) {
  const std::size_t place = place_of_[id];
  const std::size_t node = place / fan;
  if (node != root_) {
    const Aabb bounds = box_at(parent_of_[node]);
    if (!(surface(united(bounds, box)) <= 1.5 * surface(bounds))) {
      remove(id);
      return insert(id, box);
    }
  }
  boxes_.set(place, box, id);
  fit_above(node);
}

// Up to where nothing changes.
void WideTree::fit_above(std::size_t node) {
  while (node != root_) {
    const Aabb bounds = bounds_of(boxes_, {node * fan, node * fan + fan});
    const std::size_t place = parent_of_[node];
    if (box_at(place) == bounds) return;
    boxes_.set(place, bounds, static_cast<std::uint32_t>(node));
    node = place / fan;
  }
}

std::size_t WideTree::held_bytes() const {
  return boxes_.held_bytes() + touchstone::held_bytes(parent_of_) +
         touchstone::held_bytes(height_of_) + touchstone::held_bytes(place_of_);
}

}  // namespace touchstone
