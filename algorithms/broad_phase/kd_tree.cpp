// kd-tree whose nodes hold their bodies one behind the other: what of one half reaches into the
// other is handed down as a list, and the leaves are tested a vector at a time.
// Paper:   Serpa, Rodrigues, "Flexible Use of Temporal and Spatial Reasoning for Fast and Scalable
//          CPU Broad-Phase Collision Detection Using KD-Trees", Computer Graphics Forum 2019.
// Departs: bodies are split by their centres, and each node keeps the bounds of its bodies, so that
//          only those stay at an inner node that are large for it: with all that straddle the
//          plane, most of a uniform scene would. The plane is the cell's middle, on the axis where
//          it is longest for the mean size of a body; the tight cell's middle where that is far
//          from halving the bodies, and their median where that is too. While bodies move a little
//          the tree is kept, and made anew when the bounds of its leaves have grown by a quarter.
// Fails:   long thin boxes in all directions: the bounds of all nodes overlap, and each leaf is
//          tested against all that comes before it.
// Cost:    O(n log n) time, O(n log n + k) to be expected for the search; k = pairs that overlap.
//          About 100 bytes a body.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "algorithms/broad_phase.h"
#include "algorithms/kernels/box_list.h"
#include "algorithms/kernels/held_bytes.h"

namespace touchstone {
namespace {

class KdTree final : public BroadPhase {
 public:
  explicit KdTree(Executor& executor)
      : executor_(executor), scratch_(static_cast<std::size_t>(executor.width())) {}

  void build(std::span<const Aabb> boxes) override {
    list_bodies(executor_, boxes, ids_);
    grow_top(measure(boxes));
    fit();
    spread_ = spread();
  }

  void update(const FrameChange& change) override {
    if (!change.inserted.empty() || !change.removed.empty()) return build(change.boxes);
    if (change.moved.empty()) return;
    for_each_block(executor_, bodies_.size(), block_size,
                   [&](std::size_t, std::size_t first, std::size_t last) {
                     for (std::size_t i = first; i < last; ++i) {
                       bodies_[i] = body(change.boxes, bodies_[i].id);
                     }
                   });
    fit();
    // Written so that a NaN, of bounds that overflow, makes a new tree.
    if (!(spread() <= 1.25 * spread_)) build(change.boxes);
  }

  Status find_pairs(PairSink& sink) override {
    sink.start(tasks_.size());
    const auto task = [&](std::size_t i, int worker) {
      search(tasks_[i], scratch_[static_cast<std::size_t>(worker)], sink.chunk(i));
    };
    executor_.run(tasks_.size(), std::cref(task));
    return Status::ok;
  }

  BroadPhaseWork work() const override {
    Scratch scratch;
    PairBuffer pairs;
    for (const Task& task : tasks_) {
      pairs.clear();
      search(task, scratch, pairs);
    }
    scratch.work.bytes = sum_held_bytes(ids_, bodies_, ranges_, arrays_, nodes_, tops_, tasks_);
    return scratch.work;
  }

 private:
  static constexpr std::size_t block_size = 8192;
  static constexpr std::uint32_t leaf_size = 32;
  static constexpr std::uint32_t least_members = 4;  // of a node
  // A node of no more is the work of one task, with all that is below it.
  static constexpr std::uint32_t cut_size = 2048;
  static constexpr std::uint32_t rows_a_task = 512;
  // A node of no more is not looked into for those of its bodies that overlap a bound.
  static constexpr std::uint32_t collected_at_once = 256;
  static constexpr std::uint32_t none = 0xffffffff;
  static constexpr float inf = std::numeric_limits<float>::infinity();

  using Sides = std::array<float, 3>;

  struct alignas(16) Body {
    Sides min;
    std::uint32_t id;
    Sides max;
    std::uint32_t unused = 0;

    float centre(std::size_t axis) const { return 0.5f * min[axis] + 0.5f * max[axis]; }
    float size(std::size_t axis) const { return max[axis] - min[axis]; }
  };
  static void extend(Aabb& bounds, const Aabb& box) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      bounds.min[axis] = std::min(bounds.min[axis], box.min[axis]);
      bounds.max[axis] = std::max(bounds.max[axis], box.max[axis]);
    }
  }
  static Body body(std::span<const Aabb> boxes, std::uint32_t id) {
    return {boxes[id].min, id, boxes[id].max};
  }

  // Its own bodies come first, then those of the left and of the right child.
  struct Node {
    Aabb bounds = Aabb::empty();  // of all of them
    std::uint32_t first = 0, own_end = 0, last = 0;
    std::uint32_t left = none;  // the right one is the next; none of a leaf
    bool is_leaf() const { return left == none; }
  };

  // Where the centres of some bodies lie, and their greatest sizes; both may be too large.
  struct Range {
    Sides low{inf, inf, inf}, high{-inf, -inf, -inf}, size{};
    std::array<double, 3> sum_of_sizes{};

    void add(const Body& b) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        low[axis] = std::min(low[axis], b.centre(axis));
        high[axis] = std::max(high[axis], b.centre(axis));
        size[axis] = std::max(size[axis], b.size(axis));
      }
    }
    double extent(std::size_t axis) const { return double{high[axis]} - low[axis]; }
  };

  // Bodies that are yet to be split.
  struct Growing {
    std::uint32_t first = 0, last = 0;
    Range range;
  };
  struct Split {
    std::uint32_t own_end = 0;
    std::array<Growing, 2> children;  // empty ones of a leaf
    bool is_leaf() const { return children[1].last == 0; }
  };
  // A node above the cut, or at it: then the whole of what is below it is made by one task.
  struct Top {
    std::uint32_t parent;  // in the list of these; none of the root
    Growing growing;
    Split split = {};
    double spread = 0;  // of the leaves below it: the sum of their bounds' sides, metres

    bool is_whole() const { return split.is_leaf(); }
  };
  // To look for the partners of some bodies of a top node's own; of all below it, too, if it is
  // whole.
  struct Task {
    std::uint32_t top;
    IndexRange rows;
    bool whole;
  };
  struct Scratch {
    BoxList list;
    BroadPhaseWork work{.box_tests = 0, .node_visits = 0, .candidates = 0};
  };

  Range measure(std::span<const Aabb> boxes);
  void grow_top(const Range& all);
  void grow(const Growing& from, Node& node, std::uint32_t& next);
  Split split(const Growing& from);
  std::size_t longest(const Range& range) const;
  std::uint32_t keep(std::uint32_t first, std::uint32_t last, std::size_t axis, double limit,
                     Range& range);
  template <class Condition>
  std::uint32_t divide(std::uint32_t first, std::uint32_t last, const Condition& holds);
  void list_tasks();
  void fit();
  void fit(Node& node, double& spread);
  void fit_inner(Node& node);
  Aabb fit_own(const Node& node);
  double spread() const {
    double sum = 0;
    for (const Top& top : tops_) sum += top.spread;
    return sum;
  }
  void search(const Task& task, Scratch& scratch, PairBuffer& out) const;
  void search(const Node& node, IndexRange list, Scratch& scratch, PairBuffer& out) const;
  void pair(const Node& node, IndexRange rows, IndexRange list, Scratch& s, PairBuffer& out) const;
  void collect(const Node& from, const Aabb& bound, Scratch& scratch) const;
  void take(IndexRange range, const Aabb& bound, Scratch& scratch) const;

  Executor& executor_;
  std::vector<Scratch> scratch_;
  std::vector<std::uint32_t> ids_;
  std::vector<Body> bodies_;  // in the order of the tree
  std::vector<Range> ranges_;
  std::array<double, 3> weight_{};  // of an extent on each axis
  BoxArrays arrays_;                // in that order too
  // Those below a top node begin at half the place of its first body, since there are at least four
  // bodies a leaf; the top nodes come behind them all.
  std::vector<Node> nodes_;
  std::uint32_t base_ = 0;  // where the top nodes begin
  std::vector<Top> tops_;   // parents come first
  std::vector<Task> tasks_;
  double spread_ = 0;
};

KdTree::Range KdTree::measure(std::span<const Aabb> boxes) {
  bodies_.resize(ids_.size());
  ranges_.assign(block_count(ids_.size(), block_size), {});
  for_each_block(executor_, ids_.size(), block_size,
                 [&](std::size_t block, std::size_t first, std::size_t last) {
                   Range range;
                   for (std::size_t i = first; i < last; ++i) {
                     const Body& b = bodies_[i] = body(boxes, ids_[i]);
                     range.add(b);
                     for (std::size_t axis = 0; axis < 3; ++axis) {
                       range.sum_of_sizes[axis] += double{b.max[axis]} - b.min[axis];
                     }
                   }
                   ranges_[block] = range;
                 });
  Range all;
  for (const Range& range : ranges_) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      all.low[axis] = std::min(all.low[axis], range.low[axis]);
      all.high[axis] = std::max(all.high[axis], range.high[axis]);
      all.size[axis] = std::max(all.size[axis], range.size[axis]);
      all.sum_of_sizes[axis] += range.sum_of_sizes[axis];
    }
  }
  // Flat boxes are not to be told apart by a hair on the axis on which they are flat.
  const double least = 1e-3 * std::ranges::max(all.sum_of_sizes);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    weight_[axis] = least > 0 ? 1 / std::max(all.sum_of_sizes[axis], least) : 1;
  }
  return all;
}

std::size_t KdTree::longest(const Range& range) const {
  std::array<double, 3> length;
  for (std::size_t axis = 0; axis < 3; ++axis) length[axis] = range.extent(axis) * weight_[axis];
  return static_cast<std::size_t>(std::ranges::max_element(length) - length.begin());
}

// Puts those to the front for which the condition holds, and says where they end. Without a branch:
// it would be guessed wrong half the time.
template <class Condition>
std::uint32_t KdTree::divide(std::uint32_t first, std::uint32_t last, const Condition& holds) {
  std::uint32_t end = first;
  for (std::uint32_t i = first; i < last; ++i) {
    const Body b = bodies_[i];
    bodies_[i] = bodies_[end];
    bodies_[end] = b;
    end += holds(b) ? 1 : 0;
  }
  return end;
}

// Puts those to the front that are larger on the axis than the limit, unless they are many, and
// says where they end.
std::uint32_t KdTree::keep(std::uint32_t first, std::uint32_t last, std::size_t axis, double limit,
                           Range& range) {
  if (range.size[axis] <= limit) return first;
  std::uint32_t count = 0;
  float greatest = 0;
  for (std::uint32_t i = first; i < last; ++i) {
    const float size = bodies_[i].size(axis);
    const bool large = size > limit;
    count += large ? 1 : 0;
    greatest = std::max(greatest, large ? 0 : size);
  }
  // They are tested against each other, which is to cost no more than the rest.
  const double all = last - first;
  if (count > std::min(all / 8, 16 * std::sqrt(all))) return first;
  range.size[axis] = greatest;
  if (count == 0) return first;
  return divide(first, last, [&](const Body& b) { return b.size(axis) > limit; });
}

KdTree::Split KdTree::split(const Growing& from) {
  Split split;
  Range range = from.range;
  std::uint32_t first = from.first;
  const std::uint32_t last = from.last;
  for (int attempt = 0; last - first > leaf_size; ++attempt) {
    if (attempt == 1) {
      range = {};
      for (std::uint32_t i = first; i < last; ++i) range.add(bodies_[i]);
    }
    const std::size_t axis = longest(range);
    if (attempt > 0 && !(range.extent(axis) > 0)) break;
    first = keep(first, last, axis, range.extent(axis) / 2, range);
    const std::uint32_t count = last - first;
    float at = 0.5f * range.low[axis] + 0.5f * range.high[axis];
    std::uint32_t middle = first + count / 2;
    if (attempt < 2) {
      middle = divide(first, last, [&](const Body& b) { return b.centre(axis) < at; });
      const std::uint32_t smaller = std::min(middle - first, last - middle);
      if (smaller < std::max(least_members, count / 8)) continue;
    } else {
      const auto place = [&](std::uint32_t i) { return bodies_.begin() + std::ptrdiff_t{i}; };
      std::nth_element(place(first), place(middle), place(last), [&](const Body& a, const Body& b) {
        return a.centre(axis) < b.centre(axis);
      });
      at = bodies_[middle].centre(axis);
    }
    if (count <= leaf_size) break;
    split = {first, {{{first, middle, range}, {middle, last, range}}}};
    split.children[0].range.high[axis] = at;
    split.children[1].range.low[axis] = at;
    return split;
  }
  split.own_end = last;
  return split;
}

void KdTree::grow(const Growing& from, Node& node, std::uint32_t& next) {
  const Split halves = split(from);
  node = {.first = from.first, .own_end = halves.own_end, .last = from.last};
  if (halves.is_leaf()) return;
  const std::uint32_t left = node.left = next;
  next += 2;
  grow(halves.children[0], nodes_[left], next);
  grow(halves.children[1], nodes_[left + 1], next);
}

// Level by level down to the cut, so that all nodes of a level are split at the same time.
void KdTree::grow_top(const Range& all) {
  const auto count = static_cast<std::uint32_t>(bodies_.size());
  base_ = count / 2 + 2;
  tops_.clear();
  if (count > 0) tops_.push_back({.parent = none, .growing = {0, count, all}});
  for (std::size_t first = 0; first < tops_.size();) {
    const std::size_t last = tops_.size();
    const auto task = [&](std::size_t i, int) {
      Top& top = tops_[first + i];
      top.split.own_end = top.growing.last;
      if (top.growing.last - top.growing.first > cut_size) top.split = split(top.growing);
    };
    executor_.run(last - first, std::cref(task));
    for (; first < last; ++first) {
      if (tops_[first].is_whole()) continue;
      for (int side = 0; side < 2; ++side) {
        tops_.push_back({.parent = static_cast<std::uint32_t>(first),
                         .growing = tops_[first].split.children[side]});
      }
    }
  }
  nodes_.resize(std::max(nodes_.size(), base_ + tops_.size()));
  std::uint32_t child = base_ + 1;
  for (std::size_t i = 0; i < tops_.size(); ++i) {
    const Top& top = tops_[i];
    Node& node = nodes_[base_ + i];
    node = {.first = top.growing.first, .own_end = top.split.own_end, .last = top.growing.last};
    if (top.is_whole()) continue;
    node.left = child;
    child += 2;
  }
  const auto task = [&](std::size_t i, int) {
    const Growing& growing = tops_[i].growing;
    std::uint32_t next = growing.first / 2;
    if (tops_[i].is_whole()) grow(growing, nodes_[base_ + i], next);
  };
  executor_.run(tops_.size(), std::cref(task));
  list_tasks();
}

// Many bodies of a node's own, that are large or lie in one place, are cut into several tasks.
void KdTree::list_tasks() {
  tasks_.clear();
  for (std::uint32_t i = 0; i < tops_.size(); ++i) {
    const Node& node = nodes_[base_ + i];
    const bool whole = tops_[i].is_whole() && !node.is_leaf();
    if (whole) {
      tasks_.push_back({i, {node.first, node.own_end}, true});
      continue;
    }
    for (std::uint32_t row = node.first; row < node.own_end; row += rows_a_task) {
      tasks_.push_back({i, {row, std::min(row + rows_a_task, node.own_end)}, false});
    }
  }
}

// The bodies as a structure of arrays, and the nodes' bounds.
void KdTree::fit() {
  arrays_.resize(bodies_.size());
  const auto task = [&](std::size_t i, int) {
    tops_[i].spread = 0;
    if (tops_[i].is_whole()) fit(nodes_[base_ + i], tops_[i].spread);
  };
  executor_.run(tops_.size(), std::cref(task));
  for (std::size_t i = tops_.size(); i-- > 0;) {
    if (!tops_[i].is_whole()) fit_inner(nodes_[base_ + i]);
  }
}

void KdTree::fit(Node& node, double& spread) {
  if (!node.is_leaf()) {
    fit(nodes_[node.left], spread);
    fit(nodes_[node.left + 1], spread);
    return fit_inner(node);
  }
  node.bounds = fit_own(node);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    spread += double{node.bounds.max[axis]} - node.bounds.min[axis];
  }
}

void KdTree::fit_inner(Node& node) {
  node.bounds = fit_own(node);
  extend(node.bounds, nodes_[node.left].bounds);
  extend(node.bounds, nodes_[node.left + 1].bounds);
}

Aabb KdTree::fit_own(const Node& node) {
  Aabb bounds = Aabb::empty();
  for (std::uint32_t i = node.first; i < node.own_end; ++i) {
    const Aabb box{bodies_[i].min, bodies_[i].max};
    extend(bounds, box);
    arrays_.set(i, box, bodies_[i].id);
  }
  return bounds;
}

// What comes before a top node in the tree is gone through once more for each of them.
void KdTree::search(const Task& task, Scratch& scratch, PairBuffer& out) const {
  const Node& node = nodes_[base_ + task.top];
  const std::size_t first = scratch.list.start();
  for (std::uint32_t i = task.top; tops_[i].parent != none; i = tops_[i].parent) {
    const Node& parent = nodes_[base_ + tops_[i].parent];
    take({parent.first, parent.own_end}, node.bounds, scratch);
    if (base_ + i != parent.left) collect(nodes_[parent.left], node.bounds, scratch);
  }
  const IndexRange list{first, scratch.list.end()};
  if (task.whole) {
    search(node, list, scratch, out);
  } else {
    pair(node, task.rows, list, scratch, out);
  }
  scratch.list.drop(first);
}

// The list: all bodies that come before the node's own and could overlap one of them.
void KdTree::search(const Node& node, IndexRange list, Scratch& scratch, PairBuffer& out) const {
  pair(node, {node.first, node.own_end}, list, scratch, out);
  if (node.is_leaf()) return;
  for (std::uint32_t child = node.left; child < node.left + 2; ++child) {
    const Aabb& bounds = nodes_[child].bounds;
    const std::size_t first = scratch.list.start();
    scratch.list.append(bounds, list);
    scratch.work.box_tests += static_cast<std::int64_t>(list.last - list.first);
    take({node.first, node.own_end}, bounds, scratch);
    if (child != node.left) collect(nodes_[node.left], bounds, scratch);
    search(nodes_[child], {first, scratch.list.end()}, scratch, out);
    scratch.list.drop(first);
  }
}

void KdTree::pair(const Node& node, IndexRange rows, IndexRange list, Scratch& scratch,
                  PairBuffer& out) const {
  ++scratch.work.node_visits;
  if (rows.first == rows.last) return;
  pair_rows(arrays_, rows, node.own_end, scratch.list, list, out);
  const std::size_t behind = node.own_end - rows.first - 1 + (node.own_end - rows.last);
  const std::size_t tests =
      (rows.last - rows.first) * (list.last - list.first) + (rows.last - rows.first) * behind / 2;
  scratch.work.box_tests += static_cast<std::int64_t>(tests);
  scratch.work.candidates += static_cast<std::int64_t>(tests);
}

void KdTree::take(IndexRange range, const Aabb& bound, Scratch& scratch) const {
  if (range.first == range.last) return;
  scratch.list.append(bound, arrays_, range);
  scratch.work.box_tests += static_cast<std::int64_t>(range.last - range.first);
}

// Of the node's bodies and of all below it.
void KdTree::collect(const Node& from, const Aabb& bound, Scratch& scratch) const {
  ++scratch.work.node_visits;
  ++scratch.work.box_tests;
  if (!overlap(from.bounds, bound)) return;
  if (from.is_leaf() || from.last - from.first <= collected_at_once) {
    return take({from.first, from.last}, bound, scratch);
  }
  take({from.first, from.own_end}, bound, scratch);
  collect(nodes_[from.left], bound, scratch);
  collect(nodes_[from.left + 1], bound, scratch);
}

}  // namespace
}  // namespace touchstone

TOUCHSTONE_BROAD_PHASE {
  return {
      {.info = {.name = "kd-tree",
                .citation = "Serpa, Rodrigues, \"Flexible Use of Temporal and Spatial Reasoning "
                            "... Using KD-Trees\", Computer Graphics Forum 2019; split by "
                            "centres, with bounds"},
       .make = [](touchstone::Executor& executor) {
         return std::make_unique<touchstone::KdTree>(executor);
       }}};
}
