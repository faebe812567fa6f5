// The loops of block_extent.cpp, once for each level of vector instructions.

#include "algorithms/kernels/triangles/lane_points.inl"

// The ends of triangles along a way; NaN of those with a corner that is not finite.
struct LaneEnds {
  Vector low, high;
};

template <class Block>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE LaneEnds ends_at(const Block& block, std::size_t at,
                                                     const Points& way) {
  const Vector p = dot(way, points_at(block, 0, at));
  const Vector q = dot(way, points_at(block, 1, at));
  const Vector r = dot(way, points_at(block, 2, at));
  const Vector sum = p + q + r, nothing = sum - sum;
  return {Lanes::min(Lanes::min(p, q), r) + nothing, Lanes::max(Lanes::max(p, q), r) + nothing};
}

TOUCHSTONE_TARGET TOUCHSTONE_INLINE Points in_all_lanes(const Vec3d& p) {
  return {Lanes::broadcast(p[0]), Lanes::broadcast(p[1]), Lanes::broadcast(p[2])};
}

template <class Block>
TOUCHSTONE_TARGET TOUCHSTONE_FLATTEN void ends_of_block(const Block& block, const Vec3d& way,
                                                        BlockEnds& ends) {
  for (std::size_t at = 0; at < TriangleBlock::size; at += Lanes::width) {
    const LaneEnds found = ends_at(block, at, in_all_lanes(way));
    Lanes::store(&ends.low[at], found.low);
    Lanes::store(&ends.high[at], found.high);
  }
}

template <class Block>
TOUCHSTONE_TARGET TOUCHSTONE_FLATTEN void ends_along_rows(const Block& block, const Mat3d& ways,
                                                          std::array<BlockEnds, 3>& ends) {
  for (int row = 0; row < 3; ++row) ends_of_block(block, ways.row(row), ends[row]);
}

template <class Block>
TOUCHSTONE_TARGET TOUCHSTONE_FLATTEN unsigned reaching_lanes(const Block& block,
                                                             const BlockExtent& extent,
                                                             double slack) {
  const Vector first = Lanes::broadcast(extent.low - slack);
  const Vector last = Lanes::broadcast(extent.high + slack);
  unsigned beyond = 0;
  for (std::size_t at = 0; at < TriangleBlock::size; at += Lanes::width) {
    const LaneEnds found = ends_at(block, at, in_all_lanes(extent.way));
    beyond |= (Lanes::to_bits(Lanes::less(last, found.low)) |
               Lanes::to_bits(Lanes::less(found.high, first)))
              << at;
  }
  return ~beyond & ((1u << TriangleBlock::size) - 1);
}
