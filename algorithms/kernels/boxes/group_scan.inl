// The loop of group_scan.h. group_scan.cpp includes this file once for each level of vector
// instructions, inside that level's namespace.
#include "algorithms/kernels/boxes/group_search.inl"

TOUCHSTONE_TARGET std::size_t scan(const Columns boxes, IndexRange group, const Aabb& bounds,
                                   std::span<const IndexRange> others, GroupLists& lists,
                                   PairBuffer& out) {
  return pair_group_with_runs(
      boxes, group, row_of(bounds), lists, out, [&](const auto& visit) TOUCHSTONE_TARGET {
        for (const IndexRange range : others) {
          for (std::size_t j = range.first; j < range.last; j += group_size) {
            visit(j, range.last - j);
          }
        }
      });
}
