// The loops of triangle_signs.cpp, once for each level of vector instructions.

#include "algorithms/kernels/triangles/lane_points.inl"

// Edges of one triangle against the other: the lanes in which one surely pierces it, and in which
// all surely miss it.
struct Pierced {
  unsigned yes = 0, no = ~0u;

  // An edge with the sides of its ends and its three volumes.
  TOUCHSTONE_TARGET TOUCHSTONE_INLINE void add(Sign tail, Sign head, Sign r, Sign s, Sign t) {
    const unsigned crosses = (tail.plus & head.minus) | (tail.minus & head.plus);
    const unsigned stays = (tail.plus & head.plus) | (tail.minus & head.minus);
    const unsigned one_way = (r.plus & s.plus & t.plus) | (r.minus & s.minus & t.minus);
    const unsigned both_ways = (r.plus | s.plus | t.plus) & (r.minus | s.minus | t.minus);
    yes |= crosses & one_way;
    no &= stays | both_ways;
  }
};

TOUCHSTONE_TARGET TOUCHSTONE_INLINE unsigned one_side(const Sign* s) {
  return (s[0].plus & s[1].plus & s[2].plus) | (s[0].minus & s[1].minus & s[2].minus);
}

// Triangle i of a against the lanes of b from `at` on.
template <class Block>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void compare_lanes(const Block& block_a, std::size_t i,
                                                       const Points* b, const Points* edge_b,
                                                       const Points& low_b, const Points& high_b,
                                                       Vector error, unsigned wanted, unsigned& yes,
                                                       unsigned& open) {
  const Points a[3] = {point_of(block_a, 0, i), point_of(block_a, 1, i), point_of(block_a, 2, i)};
  const Points low_a = least(least(a[0], a[1]), a[2]);
  const Points high_a = greatest(greatest(a[0], a[1]), a[2]);
  // How far b begins behind a's end, and a behind b's end.
  const Points after = minus(low_b, high_a), before = minus(low_a, high_b);
  const Points gap = greatest(after, before);
  const Vector apart = error + error;
  const unsigned far = Lanes::to_bits(Lanes::less(apart, gap.x)) |
                       Lanes::to_bits(Lanes::less(apart, gap.y)) |
                       Lanes::to_bits(Lanes::less(apart, gap.z));
  yes = 0;
  open = wanted & ~far;
  if (open == 0) return;

  const Points size = minus(greatest(high_a, high_b), least(low_a, low_b));
  const Vector d = Lanes::max(Lanes::max(size.x, size.y), size.z);
  const Vector bound = d * d *
                           (Lanes::broadcast(VolumeBound::of_error) * error +
                            Lanes::broadcast(VolumeBound::of_rounding) * d) +
                       Lanes::broadcast(VolumeBound::of_underflow);
  const Vector below = Lanes::broadcast(0) - bound;

  Sign of_a[3], of_b[3];
  const Points normal_b = cross(edge_b[0], edge_b[1]);
  for (int k = 0; k < 3; ++k) of_a[k] = sign_of(dot(normal_b, minus(a[k], b[0])), bound, below);
  open &= ~one_side(of_a);
  if (open == 0) return;
  const Points edge_a[3] = {minus(a[1], a[0]), minus(a[2], a[1]), minus(a[0], a[2])};
  const Points normal_a = cross(edge_a[0], edge_a[1]);
  for (int k = 0; k < 3; ++k) of_b[k] = sign_of(dot(normal_a, minus(b[k], a[0])), bound, below);
  open &= ~one_side(of_b);
  if (open == 0) return;

  Sign edges[3][3];
  for (int k = 0; k < 3; ++k) {
    for (int j = 0; j < 3; ++j) {
      edges[k][j] = sign_of(dot(cross(edge_a[k], edge_b[j]), minus(b[j], a[k])), bound, below);
    }
  }
  Pierced pierced;
  for (int k = 0; k < 3; ++k) {
    const int next = k == 2 ? 0 : k + 1;
    pierced.add(of_a[k], of_a[next], edges[k][0], edges[k][1], edges[k][2]);
    pierced.add(of_b[k], of_b[next], edges[0][k], edges[1][k], edges[2][k]);
  }
  yes = open & pierced.yes;
  open &= ~(pierced.yes | pierced.no);
}

template <class Block>
TOUCHSTONE_TARGET TOUCHSTONE_FLATTEN bool compare_blocks(const Block& a, unsigned lanes_a,
                                                         const TriangleBlock& b, unsigned lanes_b,
                                                         double error, BlockSigns& signs) {
  const Vector off = Lanes::broadcast(error);
  signs = {};
  unsigned any = 0;
  for (std::size_t at = 0; at < TriangleBlock::size; at += Lanes::width) {
    const unsigned wanted = lanes_b >> at & lane_bits;
    const Points p[3] = {points_at(b, 0, at), points_at(b, 1, at), points_at(b, 2, at)};
    const Points edges[3] = {minus(p[1], p[0]), minus(p[2], p[1]), minus(p[0], p[2])};
    const Points low = least(least(p[0], p[1]), p[2]);
    const Points high = greatest(greatest(p[0], p[1]), p[2]);
    for (unsigned bits = wanted == 0 ? 0 : lanes_a; bits != 0; bits &= bits - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(bits));
      unsigned yes, open;
      compare_lanes(a, i, p, edges, low, high, off, wanted, yes, open);
      signs.yes[i] = static_cast<std::uint8_t>(signs.yes[i] | yes << at);
      signs.open[i] = static_cast<std::uint8_t>(signs.open[i] | open << at);
      any |= yes | open;
    }
  }
  return any != 0;
}
