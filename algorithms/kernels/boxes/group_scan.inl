// The loops of group_scan.h. Included by group_scan.cpp once for each level of vector instructions,
// inside that level's namespace: `Lanes` are its vectors, TOUCHSTONE_TARGET its attribute.

constexpr std::size_t parts = group_size / Lanes::width;

// The boxes of a group, in registers where there are enough.
struct Group {
  Lanes::Floats min[3][parts], max[3][parts];
};

TOUCHSTONE_TARGET inline Group load_group(const Columns& boxes, std::size_t first) {
  Group g;
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t part = 0; part < parts; ++part) {
      g.min[axis][part] = Lanes::load(boxes.min[axis] + first + part * Lanes::width);
      g.max[axis][part] = Lanes::load(boxes.max[axis] + first + part * Lanes::width);
    }
  }
  return g;
}

// Which of the group overlap the row's box.
TOUCHSTONE_TARGET inline unsigned overlaps_of_group(const Row& row, const Group& group) {
  unsigned lanes = 0;
  for (std::size_t part = 0; part < parts; ++part) {
    Lanes::Test test = Lanes::less_equal(group.min[0][part], row.max[0]);
    test = Lanes::less_equal(test, row.min[0], group.max[0][part]);
    for (int axis = 1; axis < 3; ++axis) {
      test = Lanes::less_equal(test, group.min[axis][part], row.max[axis]);
      test = Lanes::less_equal(test, row.min[axis], group.max[axis][part]);
    }
    lanes |= Lanes::bits(test) << (part * Lanes::width);
  }
  return lanes;
}

TOUCHSTONE_TARGET void scan(const Columns boxes, IndexRange group, const Aabb& bounds,
                            std::span<const IndexRange> others, std::uint32_t* near,
                            std::int64_t& near_count, PairBuffer& out) {
  const std::size_t size = group.last - group.first;
  const unsigned members = (1u << size) - 1;
  const std::uint32_t* const ids = boxes.ids + group.first;
  const Group g = load_group(boxes, group.first);
  for (std::size_t r = 0; r + 1 < size; ++r) {
    const unsigned lanes = overlaps_of_group(load_row(boxes, group.first + r), g);
    Lanes::write(lanes & members & (~1u << r), ids[r], ids, out);
  }
  Row bound;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    bound.min[axis] = Lanes::broadcast(bounds.min[axis]);
    bound.max[axis] = Lanes::broadcast(bounds.max[axis]);
  }
  std::size_t listed = 0;
  const auto test_listed = [&]() TOUCHSTONE_TARGET {
    for (std::size_t i = 0; i < listed; ++i) {
      const unsigned lanes = overlaps_of_group(load_row(boxes, near[i]), g);
      Lanes::write(lanes & members, boxes.ids[near[i]], ids, out);
    }
    near_count += static_cast<std::int64_t>(listed);
    listed = 0;
  };
  for (const IndexRange range : others) {
    for (std::size_t j = range.first; j < range.last; j += group_size) {
      unsigned lanes = overlaps16(bound, boxes, j);
      if (range.last - j < group_size) lanes &= (1u << (range.last - j)) - 1;
      listed += Lanes::compress_numbers(lanes, static_cast<std::uint32_t>(j), near + listed);
      if (listed >= GroupScratch::near_at_once) test_listed();
    }
  }
  test_listed();
}
