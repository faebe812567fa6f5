// The loops of box_pyramid.h. Included by box_pyramid.cpp once for each level of vector
// instructions, inside that level's namespace. The lists are the same at every level, and so is the
// order in which pairs are written.

// Which of the 16 boxes from j on, and before `end`, overlap the row's.
TOUCHSTONE_TARGET inline unsigned overlaps_before(const Row& row, const Columns& boxes,
                                                  std::size_t j, std::size_t end) {
  const unsigned lanes = overlaps16(row, boxes, j);
  return end - j < fan ? lanes & ((1u << (end - j)) - 1) : lanes;
}

// Appends those of boxes[j .. j + 15] whose bit is set; there is room for them.
TOUCHSTONE_TARGET inline void append(unsigned lanes, const Columns& boxes, std::size_t j,
                                     ListedBoxes& list) {
  const std::size_t end = list.size();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Lanes::compress(lanes, boxes.min[axis] + j, list.extent(axis) + end);
    Lanes::compress(lanes, boxes.max[axis] + j, list.extent(axis + 3) + end);
  }
  list.advance(Lanes::compress(lanes, boxes.ids + j, list.ids() + end));
}

// The nodes of a level that overlap the row, by their numbers, into scratch.nodes: found from the
// top down. Those before node `from` are left out. How many.
TOUCHSTONE_TARGET inline std::size_t descend(const Row& row, const ImplicitRTree& pyramid,
                                             std::size_t target, std::size_t from,
                                             RTreeScratch& scratch) {
  const std::span<const AabbSoA> levels = pyramid.levels();
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
      found += Lanes::compress_numbers(lanes, static_cast<std::uint32_t>(first),
                                       scratch.children.data() + found);
    }
    scratch.nodes.swap(scratch.children);
    count = found;
  }
  return count;
}

// Blocks that overlap the group's bounds, those of the group first; none before these.
TOUCHSTONE_TARGET inline void list_blocks(const ImplicitRTree& pyramid, std::size_t group,
                                          RTreeScratch& scratch) {
  const Row bounds = load_row(columns_of(pyramid.levels()[2]), group);
  const Columns blocks = columns_of(pyramid.levels()[1]);
  scratch.near.clear();
  const std::size_t parents = descend(bounds, pyramid, 2, group, scratch);
  scratch.work.node_visits += static_cast<std::int64_t>(parents);
  scratch.work.box_tests += static_cast<std::int64_t>(
      children_of(scratch.nodes, parents, pyramid.levels()[1].size(), group * fan));
  scratch.near.reserve(parents * fan);
  for (std::size_t i = 0; i < parents; ++i) {
    const std::size_t first = scratch.nodes[i] * fan;
    append(overlaps16(bounds, blocks, first), blocks, first, scratch.near);
  }
}

// Pairs of the boxes at these places with those of one block, from `first` on. The block stays in
// registers; that is why this is a function of its own.
TOUCHSTONE_TARGET [[gnu::noinline]] void pair_with_block(const Columns& boxes, std::size_t first,
                                                         const std::uint32_t* places,
                                                         std::size_t count, PairBuffer& out) {
  out.reserve((count + 1) * fan);
  IndexPair* end = out.end();
  const Columns columns = boxes;
  const Sixteen sixteen = load_sixteen(columns, first);
  const Lanes::Ids ids = Lanes::load_ids(columns.ids + first);
  for (std::size_t i = 0; i < count; ++i) {
    const unsigned lanes = overlaps(columns, places[i], sixteen);
    end = Lanes::put(lanes, columns.ids[places[i]], ids, end);
  }
  out.advance(static_cast<std::size_t>(end - out.end()));
}

// Pairs of a block's boxes with one another.
TOUCHSTONE_TARGET [[gnu::noinline]] void pair_within(const Columns& boxes, std::size_t first,
                                                     std::size_t size, PairBuffer& out) {
  out.reserve((fan + 1) * fan);
  IndexPair* end = out.end();
  const Columns columns = boxes;
  const Sixteen sixteen = load_sixteen(columns, first);
  const Lanes::Ids ids = Lanes::load_ids(columns.ids + first);
  const unsigned there = (1u << size) - 1;
  for (std::size_t r = 0; r + 1 < size; ++r) {
    const unsigned behind = there & (0xfffeu << r);
    end = Lanes::put(overlaps(columns, first + r, sixteen) & behind, columns.ids[first + r], ids,
                     end);
  }
  out.advance(static_cast<std::size_t>(end - out.end()));
}

TOUCHSTONE_TARGET void search(const ImplicitRTree& pyramid, std::size_t group,
                              RTreeScratch& scratch, PairBuffer& out) {
  const Columns boxes = columns_of(pyramid.boxes());
  const Columns blocks = columns_of(pyramid.levels()[1]);
  list_blocks(pyramid, group, scratch);
  const Columns near = columns_of(scratch.near);
  const std::size_t near_count = scratch.near.size();
  scratch.nodes.resize(std::max(scratch.nodes.size(), near_count + fan));

  for (std::size_t n = 0; n < near_count && near.ids[n] < (group + 1) * fan; ++n) {
    const std::size_t block = near.ids[n];
    const std::size_t first = block * fan;
    const std::size_t size = std::min(fan, pyramid.boxes().size() - first);
    const Row bounds = load_row(blocks, block);
    // Each pair of blocks once: with those behind.
    std::size_t found = 0;
    for (std::size_t i = n + 1; i < near_count; i += fan) {
      const unsigned lanes = overlaps_before(bounds, near, i, near_count);
      found += Lanes::compress(lanes, near.ids + i, scratch.nodes.data() + found);
    }
    pair_within(boxes, first, size, out);
    std::size_t pairs = size * (size - 1) / 2;
    std::size_t listed = 0;
    for (std::size_t i = 0; i < found; ++i) {
      const std::size_t partner = scratch.nodes[i] * fan;
      listed += Lanes::compress_numbers(overlaps16(bounds, boxes, partner),
                                        static_cast<std::uint32_t>(partner),
                                        scratch.partners.data() + listed);
      if (listed + fan > RTreeScratch::most_partners || i + 1 == found) {
        pair_with_block(boxes, first, scratch.partners.data(), listed, out);
        pairs += size * listed;
        listed = 0;
      }
    }
    scratch.work.candidates += static_cast<std::int64_t>(pairs);
    scratch.work.node_visits += static_cast<std::int64_t>(1 + found);
    scratch.work.box_tests += static_cast<std::int64_t>(
        pairs + near_count - n - 1 + children_of(scratch.nodes, found, pyramid.boxes().size(), 0));
  }
}

// Bounds of the 16 boxes below each of these nodes.
TOUCHSTONE_TARGET void bound(const AabbSoA& below, AabbSoA& above, std::size_t first,
                             std::size_t last) {
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t i = first; i < last; ++i) {
      above.min(axis)[i] = Lanes::least16(below.min(axis) + i * fan);
      above.max(axis)[i] = Lanes::greatest16(below.max(axis) + i * fan);
    }
  }
  for (std::size_t i = first; i < last; ++i) above.ids()[i] = static_cast<std::uint32_t>(i);
}

TOUCHSTONE_TARGET std::size_t list(const ImplicitRTree& pyramid, const Aabb& box,
                                   RTreeScratch& scratch) {
  Row row;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    row.min[axis] = Lanes::broadcast(box.min[axis]);
    row.max[axis] = Lanes::broadcast(box.max[axis]);
  }
  const Columns boxes = columns_of(pyramid.boxes());
  const std::size_t blocks = descend(row, pyramid, 1, 0, scratch);
  scratch.children.resize(std::max(scratch.children.size(), (blocks + 1) * fan));
  std::size_t found = 0;
  for (std::size_t i = 0; i < blocks; ++i) {
    const std::size_t first = scratch.nodes[i] * fan;
    found += Lanes::compress(overlaps16(row, boxes, first), boxes.ids + first,
                             scratch.children.data() + found);
  }
  scratch.work.node_visits += static_cast<std::int64_t>(blocks);
  scratch.work.box_tests +=
      static_cast<std::int64_t>(children_of(scratch.nodes, blocks, pyramid.boxes().size(), 0));
  return found;
}
