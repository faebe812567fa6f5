// The search of a group of up to 16 boxes, one behind the other, for boxes that overlap them. The
// loops that search include this file once for each level of vector instructions, behind
// aabb_simd.h and group_search.h. Pairs and their order are equal at every level. Used by
// group_scan.cpp, implicit_rtree.cpp and loose-octree.

// Writes the pairs of a group's boxes with each other.
TOUCHSTONE_TARGET [[gnu::noinline]] void pair_within(const Columns& boxes, IndexRange group,
                                                     PairBuffer& out) {
  const std::size_t size = group.last - group.first;
  out.reserve((group_size + 1) * group_size);
  IndexPair* end = out.end();
  const Columns columns = boxes;
  const Block16 block = load_block16(columns, group.first);
  const PairWriter::Ids ids = PairWriter::load_ids(columns.ids + group.first);
  const unsigned members = first_lanes(size);
  for (std::size_t r = 0; r + 1 < size; ++r) {
    const unsigned behind = members & (0xfffeu << r);
    const unsigned bits = overlaps16(load_row(columns, group.first + r), block) & behind;
    end = PairWriter::put(bits, columns.ids[group.first + r], ids, end);
  }
  out.advance(static_cast<std::size_t>(end - out.end()));
}

// Writes the pairs of a group's boxes with those at `places`. It is a function of its own so that
// the group stays in registers.
TOUCHSTONE_TARGET [[gnu::noinline]] void pair_with_group(const Columns& boxes, IndexRange group,
                                                         const std::uint32_t* places,
                                                         std::size_t count, PairBuffer& out) {
  out.reserve((count + 1) * group_size);
  IndexPair* end = out.end();
  const Columns columns = boxes;
  const Block16 block = load_block16(columns, group.first);
  const PairWriter::Ids ids = PairWriter::load_ids(columns.ids + group.first);
  const unsigned members = first_lanes(group.last - group.first);
  for (std::size_t i = 0; i < count; ++i) {
    const unsigned bits = overlaps16(load_row(columns, places[i]), block) & members;
    end = PairWriter::put(bits, columns.ids[places[i]], ids, end);
  }
  out.advance(static_cast<std::size_t>(end - out.end()));
}

// Writes the pairs of a group's boxes with each other and with those boxes of the runs that overlap
// the group's bounds; returns the number of the latter. for_each_run(visit) calls visit(first,
// count) for each run of at most 16 boxes.
template <class ForEachRun>
TOUCHSTONE_TARGET inline std::size_t pair_group_with_runs(const Columns& boxes, IndexRange group,
                                                          const Row& bounds, NearList& near,
                                                          PairBuffer& out,
                                                          const ForEachRun& for_each_run) {
  pair_within(boxes, group, out);
  std::size_t all = 0;
  std::size_t listed = 0;
  const auto pair_listed = [&]() TOUCHSTONE_TARGET {
    if (listed > 0) pair_with_group(boxes, group, near.data(), listed, out);
    all += listed;
    listed = 0;
  };
  for_each_run([&](std::size_t first, std::size_t count) TOUCHSTONE_TARGET {
    const unsigned bits = overlaps16(bounds, boxes, first) & first_lanes(count);
    listed +=
        Lanes::compress_indices(bits, static_cast<std::uint32_t>(first), near.data() + listed);
    if (listed >= near_at_once) pair_listed();
  });
  pair_listed();
  return all;
}
