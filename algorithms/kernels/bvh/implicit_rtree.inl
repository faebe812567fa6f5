// The loops of implicit_rtree.h. implicit_rtree.cpp includes them once for each level of vector
// instructions, inside that level's namespace. Every level makes the same lists and writes the
// pairs in the same order.

#include "algorithms/kernels/boxes/group_search.inl"

// Lists in scratch.nodes the numbers of a level's nodes that overlap the row, from node `from` on,
// by a descent from the root. Returns their number.
TOUCHSTONE_TARGET inline std::size_t descend(const Row& row, const ImplicitRTree& tree,
                                             std::size_t target, std::size_t from,
                                             RTreeScratch& scratch) {
  const std::span<const AabbSoA> levels = tree.levels();
  scratch.nodes.resize(std::max(scratch.nodes.size(), fan));
  scratch.nodes[0] = 0;
  std::size_t count = 1;
  for (std::size_t level = levels.size() - 1; level-- > target;) {
    const Columns nodes = columns_of(levels[level]);
    const std::size_t before = from >> (4 * (level - target));
    scratch.work.node_visits += static_cast<std::int64_t>(count);
    scratch.work.box_tests +=
        static_cast<std::int64_t>(children_of(scratch.nodes, count, levels[level].size(), before));
    scratch.children.resize(std::max(scratch.children.size(), (count + 1) * fan));
    std::size_t found = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t first = scratch.nodes[i] * fan;
      unsigned lanes = overlaps16(row, nodes, first);
      if (first < before) lanes &= 0xffffu << (before - first);
      found += Lanes::compress_indices(lanes, static_cast<std::uint32_t>(first),
                                       scratch.children.data() + found);
    }
    scratch.nodes.swap(scratch.children);
    count = found;
  }
  return count;
}

// Lists the blocks that overlap the group's bounds, from the group's own first block on.
TOUCHSTONE_TARGET inline void list_blocks(const ImplicitRTree& tree, std::size_t group,
                                          RTreeScratch& scratch) {
  const Row bounds = load_row(columns_of(tree.levels()[2]), group);
  const Columns blocks = columns_of(tree.levels()[1]);
  const std::size_t parents = descend(bounds, tree, 2, group, scratch);
  scratch.work.node_visits += static_cast<std::int64_t>(parents);
  scratch.work.box_tests += static_cast<std::int64_t>(
      children_of(scratch.nodes, parents, tree.levels()[1].size(), group * fan));
  scratch.blocks.drop(0);
  scratch.blocks.reserve(parents * fan);
  const MutableColumns to = aabb_simd::mutable_columns_of(scratch.blocks);
  std::size_t count = 0;
  for (std::size_t i = 0; i < parents; ++i) {
    const std::size_t first = scratch.nodes[i] * fan;
    count += compress_boxes(overlaps16(bounds, blocks, first), blocks, first, to, count);
  }
  scratch.blocks.advance(count);
}

TOUCHSTONE_TARGET void search(const ImplicitRTree& tree, std::size_t group, RTreeScratch& scratch,
                              PairBuffer& out) {
  const Columns boxes = columns_of(tree.boxes());
  const Columns blocks = columns_of(tree.levels()[1]);
  list_blocks(tree, group, scratch);
  const Columns near = columns_of(scratch.blocks);
  const std::size_t near_count = scratch.blocks.end();
  scratch.nodes.resize(std::max(scratch.nodes.size(), near_count + fan));

  for (std::size_t n = 0; n < near_count && near.ids[n] < (group + 1) * fan; ++n) {
    const std::size_t block = near.ids[n];
    const IndexRange members{block * fan, std::min((block + 1) * fan, tree.boxes().size())};
    const Row bounds = load_row(blocks, block);
    // A pair of blocks is met once, by the earlier one.
    std::size_t found = 0;
    for (std::size_t i = n + 1; i < near_count; i += fan) {
      const unsigned bits = overlaps16(bounds, near, i) & first_lanes(near_count - i);
      found += Lanes::compress(bits, near.ids + i, scratch.nodes.data() + found);
    }
    const std::size_t listed = pair_group_with_runs(boxes, members, bounds, scratch.near, out,
                                                    [&](const auto& visit) TOUCHSTONE_TARGET {
                                                      for (std::size_t i = 0; i < found; ++i)
                                                        visit(scratch.nodes[i] * fan, fan);
                                                    });
    const std::size_t size = members.last - members.first;
    const std::size_t pairs = size * (size - 1) / 2 + size * listed;
    scratch.work.candidates += static_cast<std::int64_t>(pairs);
    scratch.work.node_visits += static_cast<std::int64_t>(1 + found);
    scratch.work.box_tests += static_cast<std::int64_t>(
        pairs + near_count - n - 1 + children_of(scratch.nodes, found, tree.boxes().size(), 0));
  }
}

// Computes the bounds of the 16 boxes below each of these nodes.
TOUCHSTONE_TARGET void bound(const AabbSoA& below, AabbSoA& above, std::size_t first,
                             std::size_t last) {
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t i = first; i < last; ++i) {
      above.min(axis)[i] = Lanes::reduce_min16(below.min(axis) + i * fan);
      above.max(axis)[i] = Lanes::reduce_max16(below.max(axis) + i * fan);
    }
  }
  for (std::size_t i = first; i < last; ++i) above.ids()[i] = static_cast<std::uint32_t>(i);
}

TOUCHSTONE_TARGET std::size_t list(const ImplicitRTree& tree, const Aabb& box,
                                   RTreeScratch& scratch) {
  const Row row = row_of(box);
  const Columns boxes = columns_of(tree.boxes());
  const std::size_t blocks = descend(row, tree, 1, 0, scratch);
  scratch.children.resize(std::max(scratch.children.size(), (blocks + 1) * fan));
  std::size_t found = 0;
  for (std::size_t i = 0; i < blocks; ++i) {
    const std::size_t first = scratch.nodes[i] * fan;
    found += Lanes::compress(overlaps16(row, boxes, first), boxes.ids + first,
                             scratch.children.data() + found);
  }
  scratch.work.node_visits += static_cast<std::int64_t>(blocks);
  scratch.work.box_tests +=
      static_cast<std::int64_t>(children_of(scratch.nodes, blocks, tree.boxes().size(), 0));
  return found;
}
