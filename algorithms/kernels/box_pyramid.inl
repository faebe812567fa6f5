// The loops of box_pyramid.h. Included by box_pyramid.cpp once for each level of vector
// instructions, inside that level's namespace. The lists are the same at every level, and so is the
// order in which pairs are written.

// Which of the 16 boxes from j on overlap the row's.
TOUCHSTONE_TARGET inline unsigned overlaps16(const Row& row, const Columns& boxes, std::size_t j) {
  unsigned lanes = 0;
  for (std::size_t part = 0; part < BoxPyramid::fan; part += Lanes::width) {
    lanes |= overlaps(row, boxes, j + part) << part;
  }
  return lanes;
}

// The nodes of a level that overlap the row, among the children of `parents`; those before `from`
// are left out. Of blocks the bounds are listed too.
template <bool with_bounds>
TOUCHSTONE_TARGET inline std::size_t descend(const Row& row, const Columns& level,
                                             const std::uint32_t* parents, std::size_t count,
                                             std::uint32_t from, std::uint32_t* children,
                                             const Bounds& bounds) {
  std::size_t found = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t first = parents[i] * BoxPyramid::fan;
    unsigned lanes = overlaps16(row, level, first);
    if (first < from) lanes &= 0xffffu << (from - first);
    if constexpr (with_bounds) {
      for (int axis = 0; axis < 3; ++axis) {
        Lanes::compress(lanes, level.min[axis] + first, bounds.min[axis] + found);
        Lanes::compress(lanes, level.max[axis] + first, bounds.max[axis] + found);
      }
    }
    found += Lanes::compress_numbers(lanes, first, children + found);
  }
  return found;
}

// Pairs inside one block.
TOUCHSTONE_TARGET inline void pair_within(const Columns& boxes, std::size_t first, std::size_t size,
                                          PairBuffer& out) {
  for (std::size_t r = 0; r + 1 < size; ++r) {
    const unsigned lanes = overlaps16(load_row(boxes, first + r), boxes, first) & (0xfffeu << r);
    Lanes::write(lanes & 0xffff, boxes.ids[first + r], boxes.ids + first, out);
  }
}

// Pairs of a box of one block, the boxes from `first` on, with those of its partners; how many were
// tested. The rows that are near a partner are listed first: the length of the list is known before
// it is gone through, so that no branch has to be guessed.
TOUCHSTONE_TARGET inline std::int64_t pair_blocks(const Search& s, std::size_t first,
                                                  std::span<const std::uint32_t> partners,
                                                  PyramidScratch& scratch, PairBuffer& out) {
  constexpr std::size_t fan = BoxPyramid::fan;
  std::uint32_t* rows = scratch.rows.data();
  std::uint32_t* columns = scratch.columns.data();
  std::size_t listed = 0;
  std::size_t tests = 0;
  for (const std::uint32_t partner : partners) {
    const std::uint32_t column = partner * fan;
    const unsigned lanes = overlaps16(load_row(s.column_blocks, partner), s.rows, first);
    for (std::size_t k = 0; k < fan; ++k) columns[listed + k] = column;
    const std::size_t more =
        Lanes::compress_numbers(lanes, static_cast<std::uint32_t>(first), rows + listed);
    listed += more;
    tests += more * std::min(fan, s.column_count - column);
  }
  for (std::size_t i = 0; i < listed; ++i) {
    const unsigned lanes = overlaps16(load_row(s.rows, rows[i]), s.columns, columns[i]);
    Lanes::write(lanes, s.rows.ids[rows[i]], s.columns.ids + columns[i], out);
  }
  return static_cast<std::int64_t>(tests);
}

TOUCHSTONE_TARGET void search(const Search& s, PyramidScratch& scratch, PairBuffer& out) {
  constexpr std::size_t fan = BoxPyramid::fan;
  // Down to the blocks of `second` that are near the group.
  std::uint32_t* parents = scratch.nodes.data();
  std::uint32_t* blocks = scratch.children.data();
  const Bounds bounds = bounds_of(scratch);
  const Row group = load_row(s.group_bounds, s.group);
  parents[0] = 0;
  std::size_t count = 1;
  for (std::size_t level = s.levels.size(); level-- > 0;) {
    const std::uint32_t from = s.self ? s.first_block >> (4 * level) : 0;
    scratch.work.node_visits += static_cast<std::int64_t>(count);
    scratch.work.box_tests +=
        static_cast<std::int64_t>(children_of(parents, count, s.levels[level].size(), from));
    const Columns nodes = columns_of(s.levels[level]);
    count = level > 0 ? descend<false>(group, nodes, parents, count, from, blocks, bounds)
                      : descend<true>(group, nodes, parents, count, from, blocks, bounds);
    std::swap(parents, blocks);
  }
  std::swap(parents, blocks);

  const Columns near{{bounds.min[0], bounds.min[1], bounds.min[2]},
                     {bounds.max[0], bounds.max[1], bounds.max[2]},
                     blocks};
  const std::uint32_t* partners = scratch.partners.data();
  std::size_t start = 0;
  for (std::uint32_t block = s.first_block; block < s.last_block; ++block) {
    const std::size_t first = block * fan;
    const std::size_t size = std::min(fan, s.row_count - first);
    if (s.self) {
      pair_within(s.rows, first, size, out);
      scratch.work.candidates += static_cast<std::int64_t>(size * (size - 1) / 2);
      while (start < count && blocks[start] <= block) ++start;
    }
    const Row bound = load_row(s.row_blocks, block);
    std::size_t found = 0;
    for (std::size_t i = start; i < count; i += fan) {
      unsigned lanes = overlaps16(bound, near, i);
      if (count - i < fan) lanes &= (1u << (count - i)) - 1;
      found += Lanes::compress(lanes, blocks + i, scratch.partners.data() + found);
    }
    scratch.work.node_visits += static_cast<std::int64_t>(found);
    scratch.work.box_tests += static_cast<std::int64_t>(count - start + found * size);
    for (std::size_t i = 0; i < found; i += PyramidScratch::partners_at_once) {
      const std::size_t end = std::min(i + PyramidScratch::partners_at_once, found);
      scratch.work.candidates += pair_blocks(s, first, {partners + i, end - i}, scratch, out);
    }
  }
}
