// Part of dynamic-bvh: changes of a loaded Bvh16: bodies that come, go and move, and the regrouping
// of nodes that this makes bad. See bvh16.h.
#include <algorithm>
#include <limits>

#include "algorithms/broad_phase/dynamic_bvh/bvh16.h"
#include "algorithms/broad_phase/dynamic_bvh/surface_area.h"
#include "algorithms/core/executor/parallel_blocks.h"

namespace touchstone {
namespace {

// Children of a node that is made anew; the other places are left for those to come.
constexpr std::size_t node_fill = 14;

// Twice the centre, in double, in which the sum does not overflow. An empty child, whose centre
// would be NaN, is first in every order.
double middle(const Aabb& box, std::size_t axis) {
  return box.is_empty() ? -std::numeric_limits<double>::infinity()
                        : double{box.min[axis]} + box.max[axis];
}

// The axis on which the centres of the entries' boxes have the greatest spread.
template <class Entries>
std::size_t longest_axis(const Entries& entries) {
  std::size_t longest = 0;
  double most = -1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const auto& entry : entries) {
      if (entry.box.is_empty()) continue;
      low = std::min(low, middle(entry.box, axis));
      high = std::max(high, middle(entry.box, axis));
    }
    if (high - low > most) {
      most = high - low;
      longest = axis;
    }
  }
  return longest;
}

// The ascending order along an axis; ids decide between equal centres, so the order is unique.
auto along(std::size_t axis) {
  return [axis](const auto& a, const auto& b) {
    const double at = middle(a.box, axis);
    const double bt = middle(b.box, axis);
    return at < bt || (at == bt && a.child < b.child);
  };
}

}  // namespace

// --- nodes ---

std::size_t Bvh16::new_node(std::size_t height) {
  std::size_t node = node_count_;
  if (free_nodes_.empty()) {
    make_node_capacity(++node_count_);
  } else {
    node = free_nodes_.back();
    free_nodes_.pop_back();
  }
  height_of_[node] = static_cast<std::uint8_t>(height);
  mark_of_[node] = Mark::none;
  cost_of_[node] = 0;
  for (std::size_t place = node * fan; place < node * fan + fan; ++place) {
    boxes_.set(place, Aabb::empty(), nobody);
  }
  return node;
}

void Bvh16::drop_node(std::size_t node) {
  mark_of_[node] = Mark::none;
  free_nodes_.push_back(static_cast<std::uint32_t>(node));
}

// Writes an entry and its back link: a child node stores its place, and so does a body.
void Bvh16::put(std::size_t place, const Aabb& box, std::uint32_t child) {
  boxes_.set(place, box, child);
  (is_leaf(place / fan) ? place_of_ : parent_of_)[child] = static_cast<std::uint32_t>(place);
}

// Updates the bounds upwards, as far as they change.
void Bvh16::fit_above(std::size_t node) {
  while (node != root_) {
    const Aabb bounds = bounds_of_node(node);
    const std::size_t place = parent_of_[node];
    if (box_at(place) == bounds) return;
    boxes_.set(place, bounds, static_cast<std::uint32_t>(node));
    node = place / fan;
    mark(node);
  }
}

void Bvh16::mark(std::size_t node) {
  if (mark_of_[node] != Mark::none) return;
  mark_of_[node] = Mark::changed;
  marked_.push_back(static_cast<std::uint32_t>(node));
}

// --- bodies ---

void Bvh16::insert(std::uint32_t id, const Aabb& box) {
  std::size_t node = root_;
  while (!is_leaf(node)) node = best_child(node, box);
  add(node, box, id);
}

void Bvh16::remove(std::uint32_t id) {
  const std::size_t place = place_of_[id];
  const std::size_t node = place / fan;
  boxes_.set(place, Aabb::empty(), nobody);
  if (node != root_) mark(parent_of_[node] / fan);
  fit_above(node);
}

void Bvh16::move(std::uint32_t id, const Aabb& box) {
  const std::size_t place = place_of_[id];
  const std::size_t node = place / fan;
  if (node != root_) {
    const Aabb bounds = box_at(parent_of_[node]);
    if (!(surface(united(bounds, box)) <= most_growth * surface(bounds))) {
      remove(id);
      return insert(id, box);
    }
  }
  boxes_.set(place, box, id);
  fit_above(node);
}

void Bvh16::add(std::size_t node, const Aabb& box, std::uint32_t child) {
  const std::uint32_t* const first = boxes_.ids() + node * fan;
  const std::uint32_t* const free = std::find(first, first + fan, nobody);
  if (free == first + fan) return split(node, box, child);
  put(node * fan + static_cast<std::size_t>(free - first), box, child);
  fit_above(node);
}

void Bvh16::split(std::size_t node, const Aabb& box, std::uint32_t child) {
  std::array<Entry, fan + 1> entries;
  for (std::size_t i = 0; i < fan; ++i) {
    entries[i] = {box_at(node * fan + i), boxes_.ids()[node * fan + i]};
  }
  entries[fan] = {box, child};
  std::ranges::sort(entries, along(longest_axis(entries)));
  const std::size_t other = new_node(height_of_[node]);
  constexpr std::size_t half = (fan + 1) / 2;
  for (std::size_t i = 0; i < fan; ++i) boxes_.set(node * fan + i, Aabb::empty(), nobody);
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const std::size_t place = i < half ? node * fan + i : other * fan + i - half;
    put(place, entries[i].box, entries[i].child);
  }
  for (const std::size_t part : {node, other}) {
    if (!is_leaf(part)) cost_of_[part] = cost(part);
  }
  const Aabb bounds = bounds_of_node(other);
  if (node != root_) {
    fit_above(node);
    const std::size_t parent = parent_of_[node] / fan;
    mark(parent);
    return add(parent, bounds, static_cast<std::uint32_t>(other));
  }
  root_ = new_node(height_of_[node] + std::size_t{1});
  put(root_ * fan, bounds_of_node(node), static_cast<std::uint32_t>(node));
  put(root_ * fan + 1, bounds, static_cast<std::uint32_t>(other));
  cost_of_[root_] = cost(root_);
}

// --- worn nodes ---

std::size_t Bvh16::count_children(std::size_t node) const {
  const std::uint32_t* const first = boxes_.ids() + node * fan;
  return fan - static_cast<std::size_t>(std::count(first, first + fan, nobody));
}

// True if an inner node is to be regrouped.
bool Bvh16::is_worn(std::size_t node) const {
  if (!(cost(node) <= most_growth * cost_of_[node])) return true;
  std::size_t children = 0;
  std::size_t grandchildren = 0;
  for (std::size_t place = node * fan; place < node * fan + fan; ++place) {
    const std::uint32_t child = boxes_.ids()[place];
    if (child == nobody) continue;
    ++children;
    grandchildren += count_children(child);
  }
  return children > 2 && 2 * grandchildren < children * fan;
}

// Worn nodes wait in line, the lower ones of a frame first, since a node may be good again once
// those below it are.
std::size_t Bvh16::rebuild_worn(std::size_t enough) {
  std::ranges::sort(marked_, [&](std::uint32_t a, std::uint32_t b) {
    return height_of_[a] < height_of_[b] || (height_of_[a] == height_of_[b] && a < b);
  });
  for (const std::uint32_t node : marked_) {
    if (mark_of_[node] != Mark::changed) continue;
    const bool waits = !is_leaf(node) && is_worn(node);
    mark_of_[node] = waits ? Mark::worn : Mark::none;
    if (waits) worn_.push_back(node);
  }
  marked_.clear();
  std::size_t regrouped = 0;
  std::size_t at = 0;
  for (; at < worn_.size() && regrouped < enough; ++at) {
    const std::uint32_t node = worn_[at];
    if (mark_of_[node] != Mark::worn) continue;  // it was dropped
    mark_of_[node] = Mark::none;
    if (is_worn(node)) regrouped += regroup(node);
  }
  worn_.erase(worn_.begin(), worn_.begin() + static_cast<std::ptrdiff_t>(at));
  return regrouped;
}

// Makes the children of a node anew, from its grandchildren as they are; returns their number.
std::size_t Bvh16::regroup(std::size_t node) {
  entries_.clear();
  const bool of_bodies = height_of_[node] == 1;
  for (std::size_t place = node * fan; place < node * fan + fan; ++place) {
    const std::uint32_t child = boxes_.ids()[place];
    if (child == nobody) continue;
    for (std::size_t i = child * fan; i < child * fan + fan; ++i) {
      const Entry entry{box_at(i), boxes_.ids()[i]};
      if (entry.child == nobody) continue;
      if (of_bodies || !entry.box.is_empty()) {
        entries_.push_back(entry);
      } else {
        drop_subtree(entry.child);  // all its bodies have left
      }
    }
    drop_node(child);
    boxes_.set(place, Aabb::empty(), nobody);
  }
  const std::size_t children =
      std::clamp(block_count(entries_.size(), node_fill), std::size_t{1}, fan);
  fill_places(node * fan, children, entries_);
  cost_of_[node] = cost(node);
  fit_above(node);
  return entries_.size();
}

void Bvh16::drop_subtree(std::size_t node) {
  drop_node(node);
  if (is_leaf(node)) return;
  for (std::size_t place = node * fan; place < node * fan + fan; ++place) {
    if (boxes_.ids()[place] != nobody) drop_subtree(boxes_.ids()[place]);
  }
}

// Splits the entries into `count` new nodes at consecutive places; returns the place after them.
std::size_t Bvh16::fill_places(std::size_t place, std::size_t count, std::span<Entry> entries) {
  if (count == 1) {
    const std::size_t child = new_node(height_of_[place / fan] - std::size_t{1});
    for (std::size_t i = 0; i < entries.size(); ++i) {
      put(child * fan + i, entries[i].box, entries[i].child);
    }
    if (!is_leaf(child)) cost_of_[child] = cost(child);
    put(place, bounds_of_node(child), static_cast<std::uint32_t>(child));
    return place + 1;
  }
  const std::size_t half = entries.size() * (count / 2) / count;
  std::nth_element(entries.begin(), entries.begin() + static_cast<std::ptrdiff_t>(half),
                   entries.end(), along(longest_axis(entries)));
  place = fill_places(place, count / 2, entries.first(half));
  return fill_places(place, count - count / 2, entries.subspan(half));
}

}  // namespace touchstone
