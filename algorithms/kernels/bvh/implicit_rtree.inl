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
    scratch.work.box_tests += static_cast<std::int64_t>(
        children_of(std::span(scratch.nodes).first(count), levels[level].size(), before));
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
      children_of(std::span(scratch.nodes).first(parents), tree.levels()[1].size(), group * fan));
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

// A block of the group, and where its part of a list ends; it begins where that of the block before
// it ends.
struct Listed {
  std::size_t block, end;
};
using ListedBlocks = std::array<Listed, fan>;

// Lists in scratch.others, for each block of the group, the later blocks that overlap it; returns
// the number of the group's blocks.
TOUCHSTONE_TARGET inline std::size_t list_others(std::size_t group, RTreeScratch& scratch,
                                                 ListedBlocks& own) {
  const Columns near = columns_of(scratch.blocks);
  const std::size_t near_count = scratch.blocks.end();
  scratch.others.resize(std::max(scratch.others.size(), fan * (near_count + fan)));
  std::size_t found = 0, n = 0;
  for (; n < near_count && near.ids[n] < (group + 1) * fan; ++n) {
    const Row bounds = load_row(near, n);
    // A pair of blocks is met once, by the earlier one.
    for (std::size_t i = n + 1; i < near_count; i += fan) {
      const unsigned bits = overlaps16(bounds, near, i) & first_lanes(near_count - i);
      found += Lanes::compress(bits, near.ids + i, scratch.others.data() + found);
    }
    own[n] = {near.ids[n], found};
  }
  return n;
}

// Writes the pairs of these blocks' boxes with those that are listed as near for each, and, but for
// the first block if it `is_continued`, with each other.
TOUCHSTONE_TARGET inline void pair_listed(const ImplicitRTree& tree, std::span<const Listed> near,
                                          bool is_continued, RTreeScratch& scratch,
                                          PairBuffer& out) {
  const Columns boxes = columns_of(tree.boxes());
  std::size_t hits = 0, from = 0;
  for (const Listed& listed : near) {
    const std::size_t first = listed.block * fan;
    hits = hit_group(boxes, {first, std::min(first + fan, tree.boxes().size())}, !is_continued,
                     {from, listed.end}, scratch.lists, hits);
    from = listed.end;
    is_continued = false;
  }
  put_hits(boxes, scratch.lists, hits, out);
}

// Each stage goes through all blocks of the group before the next one begins, so that it does not
// wait for results of the last.
TOUCHSTONE_TARGET void search(const ImplicitRTree& tree, std::size_t group, RTreeScratch& scratch,
                              PairBuffer& out) {
  const Columns boxes = columns_of(tree.boxes());
  const Columns blocks = columns_of(tree.levels()[1]);
  list_blocks(tree, group, scratch);
  ListedBlocks own, near;
  const std::size_t count = list_others(group, scratch, own);
  std::size_t from = 0, listed = 0, at = 0;
  bool is_continued = false;
  for (std::size_t n = 0; n < count; ++n) {
    const Row bounds = load_row(blocks, own[n].block);
    const std::span others = std::span(scratch.others).subspan(from, own[n].end - from);
    from = own[n].end;
    std::size_t near_boxes = 0;
    for (const std::uint32_t other : others) {
      const std::size_t first = other * fan;
      const std::size_t found = Lanes::compress_indices(overlaps16(bounds, boxes, first),
                                                        static_cast<std::uint32_t>(first),
                                                        scratch.lists.near.data() + listed);
      listed += found;
      near_boxes += found;
      if (listed < near_at_once) continue;
      near[n] = {own[n].block, listed};
      pair_listed(tree, std::span(near).subspan(at, n + 1 - at), is_continued, scratch, out);
      is_continued = true;
      at = n;
      listed = 0;
    }
    near[n] = {own[n].block, listed};
    const std::size_t size = std::min(fan, tree.boxes().size() - own[n].block * fan);
    const std::size_t pairs = size * (size - 1) / 2 + size * near_boxes;
    scratch.work.candidates += static_cast<std::int64_t>(pairs);
    scratch.work.node_visits += static_cast<std::int64_t>(1 + others.size());
    scratch.work.box_tests += static_cast<std::int64_t>(
        pairs + scratch.blocks.end() - n - 1 + children_of(others, tree.boxes().size(), 0));
  }
  pair_listed(tree, std::span(near).subspan(at, count - at), is_continued, scratch, out);
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
  scratch.work.box_tests += static_cast<std::int64_t>(
      children_of(std::span(scratch.nodes).first(blocks), tree.boxes().size(), 0));
  return found;
}
