// The search of a group of up to 16 boxes, one behind the other, for boxes that overlap them. The
// loops that search include this file once for each level of vector instructions, behind
// aabb_simd.h and group_search.h. Pairs and their order are equal at every level. Used by
// group_scan.cpp, implicit_rtree.cpp and loose-octree.

// Lists as hits, of which there are `hits`, a group's boxes that overlap later ones of it, if
// `is_first`, and then the near boxes that overlap any of the group's; returns how many hits there
// then are. No branch depends on what overlaps. It is a function of its own so that the group stays
// in registers.
[[gnu::noinline]] TOUCHSTONE_TARGET std::size_t hit_group(const Columns& boxes, IndexRange group,
                                                          bool is_first, IndexRange near,
                                                          GroupLists& lists, std::size_t hits) {
  const Columns columns = boxes;
  const Block16 block = load_block16(columns, group.first);
  const std::size_t size = group.last - group.first;
  const unsigned members = first_lanes(size);
  std::size_t end = hits;
  const auto list = [&](std::size_t place, unsigned bits) TOUCHSTONE_TARGET {
    lists.places[end] = static_cast<std::uint32_t>(place);
    lists.bits[end] = static_cast<std::uint16_t>(bits);
    end += bits != 0 ? 1 : 0;
  };
  for (std::size_t r = 0; is_first && r + 1 < size; ++r) {
    const unsigned behind = members & (0xfffeu << r);
    list(group.first + r, overlaps16(load_row(columns, group.first + r), block) & behind);
  }
  for (std::size_t i = near.first; i < near.last; ++i) {
    const std::uint32_t place = lists.near[i];
    list(place, overlaps16(load_row(columns, place), block) & members);
  }
  for (std::size_t i = hits; i < end; i += group_size) {
    Lanes::fill(static_cast<std::uint32_t>(group.first), lists.firsts.data() + i);
  }
  return end;
}

// Writes the pairs of the hits.
TOUCHSTONE_TARGET inline void put_hits(const Columns& boxes, const GroupLists& lists,
                                       std::size_t hits, PairBuffer& out) {
  out.reserve((hits + 1) * group_size);
  IndexPair* end = out.end();
  for (std::size_t i = 0; i < hits; ++i) {
    const PairWriter::Ids ids = PairWriter::load_ids(boxes.ids + lists.firsts[i]);
    end = PairWriter::put(lists.bits[i], boxes.ids[lists.places[i]], ids, end);
  }
  out.advance(static_cast<std::size_t>(end - out.end()));
}

// Writes the pairs of a group's boxes with each other and with those boxes of the runs that overlap
// the group's bounds; returns the number of the latter. for_each_run(visit) calls visit(first,
// count) for each run of at most 16 boxes.
template <class ForEachRun>
TOUCHSTONE_TARGET inline std::size_t pair_group_with_runs(const Columns& boxes, IndexRange group,
                                                          const Row& bounds, GroupLists& lists,
                                                          PairBuffer& out,
                                                          const ForEachRun& for_each_run) {
  std::size_t all = 0;
  std::size_t listed = 0;
  bool is_first = true;
  const auto pair_listed = [&]() TOUCHSTONE_TARGET {
    put_hits(boxes, lists, hit_group(boxes, group, is_first, {0, listed}, lists, 0), out);
    is_first = false;
    all += listed;
    listed = 0;
  };
  for_each_run([&](std::size_t first, std::size_t count) TOUCHSTONE_TARGET {
    const unsigned bits = overlaps16(bounds, boxes, first) & first_lanes(count);
    listed += Lanes::compress_indices(bits, static_cast<std::uint32_t>(first),
                                      lists.near.data() + listed);
    if (listed >= near_at_once) pair_listed();
  });
  if (is_first || listed > 0) pair_listed();
  return all;
}
