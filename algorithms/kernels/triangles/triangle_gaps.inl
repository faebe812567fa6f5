// The loops of triangle_gaps.cpp, once for each level of vector instructions.

#include "algorithms/kernels/triangles/lane_points.inl"

// The boxes of a block's triangles, and where they begin and end along a way.
struct alignas(64) BlockEnds {
  std::array<std::array<double, TriangleBlock::size>, 3> low, high;
  std::array<double, TriangleBlock::size> begin, end;
};

TOUCHSTONE_TARGET TOUCHSTONE_INLINE void find_ends(const TriangleBlock& block, const Points& way,
                                                   BlockEnds& ends) {
  for (std::size_t at = 0; at < TriangleBlock::size; at += Lanes::width) {
    const Points p[3] = {points_at(block, 0, at), points_at(block, 1, at), points_at(block, 2, at)};
    const Points low = least(least(p[0], p[1]), p[2]), high = greatest(greatest(p[0], p[1]), p[2]);
    const Vector along[3] = {dot(way, p[0]), dot(way, p[1]), dot(way, p[2])};
    Lanes::store(&ends.low[0][at], low.x);
    Lanes::store(&ends.low[1][at], low.y);
    Lanes::store(&ends.low[2][at], low.z);
    Lanes::store(&ends.high[0][at], high.x);
    Lanes::store(&ends.high[1][at], high.y);
    Lanes::store(&ends.high[2][at], high.z);
    Lanes::store(&ends.begin[at], Lanes::min(Lanes::min(along[0], along[1]), along[2]));
    Lanes::store(&ends.end[at], Lanes::max(Lanes::max(along[0], along[1]), along[2]));
  }
}

TOUCHSTONE_TARGET TOUCHSTONE_FLATTEN inline NearTriangles near_lanes(
    const TriangleBlock& a, unsigned count_a, const TriangleBlock& b, unsigned count_b,
    const Vec3d& way, double limit) {
  const Points along = {Lanes::broadcast(way[0]), Lanes::broadcast(way[1]),
                        Lanes::broadcast(way[2])};
  BlockEnds of_a, of_b;
  find_ends(a, along, of_a);
  find_ends(b, along, of_b);
  const double raised = limit * (1 + 0x1p-40);
  const Vector zero = Lanes::broadcast(0), furthest = Lanes::broadcast(raised);
  const Vector square = Lanes::broadcast(raised * raised + 3 * std::numeric_limits<double>::min());
  const unsigned all_b = (1u << count_b) - 1;
  NearTriangles near{};
  for (std::size_t i = 0; i < count_a; ++i) {
    unsigned far = 0;
    for (std::size_t at = 0; at < TriangleBlock::size; at += Lanes::width) {
      Vector sum = zero;
      for (std::size_t k = 0; k < 3; ++k) {
        const Vector after = Lanes::load(&of_b.low[k][at]) - Lanes::broadcast(of_a.high[k][i]);
        const Vector before = Lanes::broadcast(of_a.low[k][i]) - Lanes::load(&of_b.high[k][at]);
        const Vector gap = Lanes::max(Lanes::max(after, before), zero);
        sum = sum + gap * gap;
      }
      const Vector gap = Lanes::load(&of_b.begin[at]) - Lanes::broadcast(of_a.end[i]);
      far |= (Lanes::to_bits(Lanes::less(square, sum)) | Lanes::to_bits(Lanes::less(furthest, gap)))
             << at;
    }
    near[i] = static_cast<std::uint8_t>(all_b & ~far);
  }
  return near;
}
