// The loops of block_extent.cpp, once for each level of vector instructions.

#include "algorithms/kernels/triangles/lane_points.inl"

// The ends of triangles along a way; NaN of those with a corner that is not finite.
struct LaneEnds {
  Vector low, high;
};

TOUCHSTONE_TARGET TOUCHSTONE_INLINE LaneEnds ends_along(const Points* corners, const Points& way) {
  const Vector p = dot(way, corners[0]), q = dot(way, corners[1]), r = dot(way, corners[2]);
  const Vector sum = p + q + r, nothing = sum - sum;
  return {Lanes::min(Lanes::min(p, q), r) + nothing, Lanes::max(Lanes::max(p, q), r) + nothing};
}

TOUCHSTONE_TARGET TOUCHSTONE_INLINE Points in_all_lanes(const Vec3d& p) {
  return {Lanes::broadcast(p[0]), Lanes::broadcast(p[1]), Lanes::broadcast(p[2])};
}

// The ends along as many ways as `ends` has room for, a row each.
template <class Block, class Ways, std::size_t count>
TOUCHSTONE_TARGET TOUCHSTONE_FLATTEN void ends_of_block(const Block& block, const Ways& ways,
                                                        std::array<BlockEnds, count>& ends) {
  for (std::size_t at = 0; at < TriangleBlock::size; at += Lanes::width) {
    const Points corners[3] = {points_at(block, 0, at), points_at(block, 1, at),
                               points_at(block, 2, at)};
    for (std::size_t row = 0; row < count; ++row) {
      const LaneEnds found =
          ends_along(corners, in_all_lanes(ways.row(static_cast<Eigen::Index>(row))));
      Lanes::store(&ends[row].low[at], found.low);
      Lanes::store(&ends[row].high[at], found.high);
    }
  }
}

template <class Block>
TOUCHSTONE_TARGET TOUCHSTONE_FLATTEN unsigned reaching_lanes(const Block& block,
                                                             const BlockExtent& extent,
                                                             double slack) {
  const Vector first = Lanes::broadcast(extent.low - slack);
  const Vector last = Lanes::broadcast(extent.high + slack);
  unsigned beyond = 0;
  for (std::size_t at = 0; at < TriangleBlock::size; at += Lanes::width) {
    const Points corners[3] = {points_at(block, 0, at), points_at(block, 1, at),
                               points_at(block, 2, at)};
    const LaneEnds found = ends_along(corners, in_all_lanes(extent.way));
    beyond |= (Lanes::to_bits(Lanes::less(last, found.low)) |
               Lanes::to_bits(Lanes::less(found.high, first)))
              << at;
  }
  return ~beyond & ((1u << TriangleBlock::size) - 1);
}
