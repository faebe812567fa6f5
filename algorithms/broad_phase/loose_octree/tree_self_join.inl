// Part of loose-octree: finds all pairs of boxes that overlap, of which one is below a node of a
// block and the other below the same node or one listed after it. tree_self_join.cpp includes these
// loops once for each level of vector instructions, inside that level's namespace.
//
// A list of the stack holds the nodes of a block and then the later nodes that overlap them. In all
// functions `behind` is the range of the list that holds the later ones for this block.

#include "algorithms/kernels/boxes/group_search.inl"

TOUCHSTONE_TARGET inline unsigned leaves_among(const std::uint32_t* refs) {
  unsigned lanes = 0;
  for (std::size_t part = 0; part < fan; part += Lanes::width) {
    lanes |= Lanes::test(refs + part, NodeRef::leaf_bit) << part;
  }
  return lanes;
}

// The bounds of a block; unlimited for the root's.
TOUCHSTONE_TARGET inline Row bounds_of_block(const Join& join, std::size_t block) {
  if (block != 0) return load_row(join.nodes, join.tree.parent[block]);
  Row row;
  for (int axis = 0; axis < 3; ++axis) {
    row.max[axis] = Lanes::broadcast(std::numeric_limits<float>::max());
    row.min[axis] = Lanes::broadcast(std::numeric_limits<float>::lowest());
  }
  return row;
}

// Appends the boxes from[j .. j + 15] whose bits are set; the list has room for them.
TOUCHSTONE_TARGET inline void append(unsigned bits, const Columns& from, std::size_t j,
                                     AabbStack& list) {
  list.advance(compress_boxes(bits, from, j, mutable_columns_of(list), list.end()));
}

inline void make_room(std::vector<std::uint32_t>& list, std::size_t size) {
  if (list.size() < size + fan) list.resize(2 * (size + fan));
}

// Starts a list: the block's nodes, then the leaves in `behind` that overlap the block's bounds,
// then the children of the inner nodes there that do.
TOUCHSTONE_TARGET inline IndexRange list_nodes(const Join& join, std::size_t block,
                                               IndexRange behind) {
  JoinScratch& s = join.scratch;
  const Row bound = bounds_of_block(join, block);
  const std::size_t first = s.list.start();
  s.list.reserve(fan + (behind.last - behind.first));
  append(overlaps16(bound, join.nodes, block * fan), join.nodes, block * fan, s.list);
  make_room(s.inner, behind.last - behind.first);
  std::size_t inner = 0;
  const Columns from = columns_of(s.list);
  for (std::size_t j = behind.first; j < behind.last; j += fan) {
    const unsigned lanes = overlaps16(bound, from, j) & first_lanes(behind.last - j);
    const unsigned leaves = leaves_among(from.ids + j);
    append(lanes & leaves, from, j, s.list);
    inner += Lanes::compress(lanes & ~leaves, from.ids + j, s.inner.data() + inner);
  }
  s.list.reserve(inner * fan);
  for (std::size_t i = 0; i < inner; ++i) {
    const NodeRef ref{s.inner[i]};
    append(overlaps16(bound, join.nodes, ref.begin() * fan), join.nodes, ref.begin() * fan, s.list);
    s.work.box_tests += static_cast<std::int64_t>(ref.count());
  }
  s.work.node_visits += static_cast<std::int64_t>(inner + 1);
  s.work.box_tests += static_cast<std::int64_t>(behind.last - behind.first);
  return {first, s.list.end()};
}

// Lists in scratch.leaves the leaves that overlap the bound: those in `behind` and those below its
// inner nodes. Returns their number.
TOUCHSTONE_TARGET inline std::size_t list_leaves(const Join& join, const Row& bound,
                                                 IndexRange behind) {
  JoinScratch& s = join.scratch;
  const Columns from = columns_of(s.list);
  const Columns nodes = join.nodes;
  make_room(s.leaves, behind.last - behind.first);
  make_room(s.inner, behind.last - behind.first);
  std::size_t count = 0;
  std::size_t inner = 0;
  for (std::size_t j = behind.first; j < behind.last; j += fan) {
    const unsigned lanes = overlaps16(bound, from, j) & first_lanes(behind.last - j);
    const unsigned leaves = leaves_among(from.ids + j);
    count += Lanes::compress(lanes & leaves, from.ids + j, s.leaves.data() + count);
    inner += Lanes::compress(lanes & ~leaves, from.ids + j, s.inner.data() + inner);
  }
  std::size_t tests = behind.last - behind.first;
  for (std::size_t i = 0; i < inner; ++i) {
    const NodeRef ref{s.inner[i]};
    const std::size_t j = ref.begin() * fan;
    const unsigned lanes = overlaps16(bound, nodes, j);
    const unsigned leaves = leaves_among(nodes.ids + j);
    make_room(s.leaves, count);
    make_room(s.inner, inner);
    count += Lanes::compress(lanes & leaves, nodes.ids + j, s.leaves.data() + count);
    inner += Lanes::compress(lanes & ~leaves, nodes.ids + j, s.inner.data() + inner);
    tests += ref.count();
  }
  s.work.node_visits += static_cast<std::int64_t>(inner);
  s.work.box_tests += static_cast<std::int64_t>(tests);
  return count;
}

// Writes the pairs of a leaf's boxes, with each other and with the boxes of the leaves in `behind`.
TOUCHSTONE_TARGET inline void pair_leaf(const Join& join, std::size_t node, IndexRange behind) {
  JoinScratch& s = join.scratch;
  const NodeRef leaf{join.nodes.ids[node]};
  const Row bound = load_row(join.nodes, node);
  const std::size_t leaves = list_leaves(join, bound, behind);
  const IndexRange members{leaf.begin(), leaf.begin() + leaf.count()};
  const std::size_t listed = pair_group_with_runs(
      join.boxes, members, bound, s.lists, join.out, [&](const auto& visit) TOUCHSTONE_TARGET {
        for (std::size_t i = 0; i < leaves; ++i) {
          const NodeRef other{s.leaves[i]};
          visit(other.begin(), other.count());
          s.work.box_tests += static_cast<std::int64_t>(other.count());
        }
      });
  const std::size_t candidates = leaf.count() * (leaf.count() - 1) / 2 + listed * leaf.count();
  s.work.candidates += static_cast<std::int64_t>(candidates);
  s.work.box_tests += static_cast<std::int64_t>(candidates);
}

// Joins each node of the block with the nodes after it in the block and with those in `behind`, and
// descends into inner nodes if `part` says so.
TOUCHSTONE_TARGET void join(const Join& all, std::size_t block, IndexRange behind, JoinPart part) {
  const IndexRange list = list_nodes(all, block, behind);
  for (std::size_t node = block * fan; node < block * fan + fan; ++node) {
    if (all.nodes.min[0][node] > all.nodes.max[0][node]) break;
    const NodeRef ref{all.nodes.ids[node]};
    const IndexRange rest{list.first + (node - block * fan) + 1, list.last};
    if (ref.is_leaf()) {
      pair_leaf(all, node, rest);
    } else if (part == JoinPart::all) {
      join(all, ref.begin(), rest, part);
    }
  }
  all.scratch.list.drop(list.first);
}

// Starts the lists of the path from the root to the block, and returns the range of the last one
// that the block's nodes are joined with.
TOUCHSTONE_TARGET IndexRange list_behind(const Join& all, std::size_t block) {
  if (block == 0) return {0, 0};
  const std::size_t node = all.tree.parent[block];
  const IndexRange behind = list_behind(all, node / fan);
  const IndexRange list = list_nodes(all, node / fan, behind);
  return {list.first + node % fan + 1, list.last};
}

// Joins a block without the lists of its parents, which are made first.
TOUCHSTONE_TARGET void join_from_root(const Join& all, std::size_t block, JoinPart part) {
  const std::size_t first = all.scratch.list.start();
  join(all, block, list_behind(all, block), part);
  all.scratch.list.drop(first);
}
