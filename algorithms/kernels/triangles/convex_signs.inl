// The loops of convex_signs.cpp, once for each level of vector instructions.
#include "algorithms/kernels/triangles/lane_points.inl"

// The lanes that surely share a point with the shape, and those that surely do not.
struct Proven {
  unsigned yes = 0, no = 0;
};

// Triangles in lanes, with what all shapes need of them.
struct Triangles {
  Points corner[3], edge[3];
  Points low, high;
  Vector greatest;  // magnitude of a coordinate, the shape's too
  Vector slack;     // see convex_signs.cpp
};

TOUCHSTONE_TARGET TOUCHSTONE_INLINE Points plus(const Points& p, const Points& q) {
  return {p.x + q.x, p.y + q.y, p.z + q.z};
}
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Points times(const Points& p, Vector s) {
  return {p.x * s, p.y * s, p.z * s};
}
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Points select(typename Lanes::Mask mask, const Points& p,
                                                  const Points& q) {
  return {Lanes::select(mask, p.x, q.x), Lanes::select(mask, p.y, q.y),
          Lanes::select(mask, p.z, q.z)};
}
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Vector sum_of_magnitudes(const Points& p) {
  return Lanes::abs(p.x) + Lanes::abs(p.y) + Lanes::abs(p.z);
}
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Vector greatest_magnitude(const Points& p) {
  return Lanes::max_abs(Lanes::max_abs(p.x, p.y), p.z);
}
// NaN becomes `high`.
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Vector clamped(Vector x, Vector low, Vector high) {
  return Lanes::max(Lanes::min(x, high), low);
}
TOUCHSTONE_TARGET TOUCHSTONE_INLINE unsigned above(Vector x, Vector bound) {
  return Lanes::to_bits(Lanes::less(bound, x));
}

// Lanes whose boxes are further than the radius from the core's box.
TOUCHSTONE_TARGET TOUCHSTONE_INLINE unsigned apart_from_box(const Triangles& t,
                                                            const LaneConvex& convex) {
  const Vector reach = Lanes::broadcast(convex.radius) + t.slack;
  const Vector gap_x = Lanes::max(t.low.x - Lanes::broadcast(convex.high[0]),
                                  Lanes::broadcast(convex.low[0]) - t.high.x);
  const Vector gap_y = Lanes::max(t.low.y - Lanes::broadcast(convex.high[1]),
                                  Lanes::broadcast(convex.low[1]) - t.high.y);
  const Vector gap_z = Lanes::max(t.low.z - Lanes::broadcast(convex.high[2]),
                                  Lanes::broadcast(convex.low[2]) - t.high.z);
  return above(gap_x, reach) | above(gap_y, reach) | above(gap_z, reach);
}

// --- spheres and capsules -------------------------------------------------------------------------

// A segment along z, or the origin, against the triangles: the nearest points, as the direction
// between them and its squared length.
template <bool is_point>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Proven round_shape(const Triangles& t,
                                                       const LaneConvex& convex) {
  const Vector zero = Lanes::broadcast(0), one = Lanes::broadcast(1);
  const Vector top = Lanes::broadcast(convex.half_length), bottom = zero - top;
  Vector least = Lanes::broadcast(infinite);
  Points way = {zero, zero, zero};
  for (int k = 0; k < 3; ++k) {
    const Points &p = t.corner[k], &e = t.edge[k];
    Vector z = zero;
    const Vector flat = p.x * e.x + p.y * e.y, flat_square = e.x * e.x + e.y * e.y;
    if (!is_point) {
      const Vector s = clamped((zero - flat) / flat_square, zero, one);
      z = clamped(p.z + s * e.z, bottom, top);
    }
    const Vector s =
        clamped((zero - (flat + (p.z - z) * e.z)) / (flat_square + e.z * e.z), zero, one);
    Points d = plus(p, times(e, s));
    if (!is_point) z = clamped(d.z, bottom, top);
    d.z = d.z - z;
    const Vector square = dot(d, d);
    const auto nearer = Lanes::less(square, least);
    least = Lanes::select(nearer, square, least);
    way = select(nearer, d, way);
  }
  const Points normal = cross(t.edge[0], t.edge[1]);
  Points from[3] = {t.corner[0], t.corner[1], t.corner[2]};
  if (!is_point) {
    const Vector z = clamped(dot(normal, t.corner[0]) / normal.z, bottom, top);
    for (int k = 0; k < 3; ++k) from[k].z = from[k].z - z;
  }
  const Vector w0 = dot(normal, cross(from[1], from[2])), w1 = dot(normal, cross(from[2], from[0])),
               w2 = dot(normal, cross(from[0], from[1]));
  const Vector share = one / (w0 + w1 + w2);
  const Points foot =
      times(plus(plus(times(from[0], w0), times(from[1], w1)), times(from[2], w2)), share);
  const Vector square = dot(foot, foot);
  const unsigned inside = Lanes::to_bits(Lanes::less_equal(zero, w0)) &
                          Lanes::to_bits(Lanes::less_equal(zero, w1)) &
                          Lanes::to_bits(Lanes::less_equal(zero, w2)) &
                          Lanes::to_bits(Lanes::less_equal(square, least));
  const auto is_foot = Lanes::from_bits(inside);
  least = Lanes::select(is_foot, square, least);
  const auto behind = Lanes::less(dot(normal, from[0]), zero);
  const Points outward = select(behind, minus({zero, zero, zero}, normal), normal);
  way = select(is_foot, outward, way);

  const Vector radius = Lanes::broadcast(convex.radius);
  Proven proven;
  proven.yes = Lanes::to_bits(
      Lanes::less_equal(Lanes::sqrt(least + Lanes::broadcast(1e-290)) + t.slack, radius));
  Vector begin =
      Lanes::min(Lanes::min(dot(way, t.corner[0]), dot(way, t.corner[1])), dot(way, t.corner[2]));
  if (!is_point) begin = begin - top * Lanes::abs(way.z);
  const Vector reach =
      Lanes::sqrt(dot(way, way)) * (radius * Lanes::broadcast(1 + 0x1p-48) + t.slack);
  proven.no = above(begin, reach + Lanes::broadcast(underflow));
  return proven;
}

// --- boxes ----------------------------------------------------------------------------------------

// Adds an axis of a cross product of a unit vector and an edge (y, z): the projections of the edge
// and of the third corner are `on` and `off`.
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void add_edge_axis(Vector on, Vector off, Vector y, Vector z,
                                                       Vector half_y, Vector half_z, Vector slack,
                                                       Proven& proven) {
  const Vector length_y = Lanes::abs(y), length_z = Lanes::abs(z), length = length_y + length_z;
  const Vector reach = half_y * length_z + half_z * length_y;
  const Vector gap =
      Lanes::max(Lanes::min(on, off), Lanes::broadcast(0) - Lanes::max(on, off)) - reach;
  const Vector bound = length * slack + Lanes::broadcast(underflow);
  proven.no |= above(gap, bound);
  proven.yes &= above(Lanes::broadcast(0) - gap, bound) |
                Lanes::to_bits(Lanes::less_equal(length, Lanes::broadcast(0)));
}

TOUCHSTONE_TARGET TOUCHSTONE_INLINE Proven box_shape(const Triangles& t, const LaneConvex& convex) {
  const Vector zero = Lanes::broadcast(0);
  const Points half = {Lanes::broadcast(convex.high[0]), Lanes::broadcast(convex.high[1]),
                       Lanes::broadcast(convex.high[2])};
  Proven proven = {~0u, 0};
  const Vector gap_x = Lanes::max(t.low.x, zero - t.high.x) - half.x;
  const Vector gap_y = Lanes::max(t.low.y, zero - t.high.y) - half.y;
  const Vector gap_z = Lanes::max(t.low.z, zero - t.high.z) - half.z;
  proven.yes =
      above(zero - gap_x, t.slack) & above(zero - gap_y, t.slack) & above(zero - gap_z, t.slack);
  proven.no = above(gap_x, t.slack) | above(gap_y, t.slack) | above(gap_z, t.slack);

  const Points normal = cross(t.edge[0], t.edge[1]);
  const Vector longest =
      Lanes::max_abs(greatest_magnitude(t.edge[0]), greatest_magnitude(t.edge[1]));
  const Vector bound = sum_of_magnitudes(normal) * t.slack +
                       Lanes::broadcast(64 * u) * longest * longest * t.greatest +
                       Lanes::broadcast(underflow);
  const Vector gap = Lanes::abs(dot(normal, t.corner[0])) -
                     (half.x * Lanes::abs(normal.x) + half.y * Lanes::abs(normal.y) +
                      half.z * Lanes::abs(normal.z));
  proven.no |= above(gap, bound);
  proven.yes &= above(zero - gap, bound);

  for (int k = 0; k < 3; ++k) {
    const Points &e = t.edge[k], &p = t.corner[k], &q = t.corner[k == 0 ? 2 : k - 1];
    add_edge_axis(p.z * e.y - p.y * e.z, q.z * e.y - q.y * e.z, e.y, e.z, half.y, half.z, t.slack,
                  proven);
    add_edge_axis(p.x * e.z - p.z * e.x, q.x * e.z - q.z * e.x, e.z, e.x, half.z, half.x, t.slack,
                  proven);
    add_edge_axis(p.y * e.x - p.x * e.y, q.y * e.x - q.x * e.y, e.x, e.y, half.x, half.y, t.slack,
                  proven);
  }
  proven.yes &= ~proven.no;
  return proven;
}

// --- hulls ----------------------------------------------------------------------------------------

// The point of hull - triangle that is furthest along d. Lanes that d separates are added to `no`.
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Points furthest(const Triangles& t, const LaneConvex& convex,
                                                    const Points& d, unsigned& no) {
  Vector most = Lanes::broadcast(-infinite);
  Points at = {most, most, most};
  for (std::size_t i = 0; i < convex.x.size(); ++i) {
    const Points v = {Lanes::broadcast(convex.x[i]), Lanes::broadcast(convex.y[i]),
                      Lanes::broadcast(convex.z[i])};
    const Vector along = dot(d, v);
    const auto further = Lanes::less(most, along);
    most = Lanes::select(further, along, most);
    at = select(further, v, at);
  }
  Vector least = dot(d, t.corner[0]);
  Points near = t.corner[0];
  for (int k = 1; k < 3; ++k) {
    const Vector along = dot(d, t.corner[k]);
    const auto less = Lanes::less(along, least);
    least = Lanes::select(less, along, least);
    near = select(less, t.corner[k], near);
  }
  no |= above(least - most, sum_of_magnitudes(d) * t.slack + Lanes::broadcast(underflow));
  return minus(at, near);
}

// Lanes in which the tetrahedron of the corners surely has the origin inside.
TOUCHSTONE_TARGET TOUCHSTONE_INLINE unsigned surely_encloses(const Triangles& t, const Points& a,
                                                             const Points& b, const Points& c,
                                                             const Points& d) {
  const Vector size = Lanes::max(Lanes::max(greatest_magnitude(a), greatest_magnitude(b)),
                                 Lanes::max(greatest_magnitude(c), greatest_magnitude(d)));
  const Vector bound =
      size * size * (Lanes::broadcast(128) * t.slack + Lanes::broadcast(64 * u) * size) +
      Lanes::broadcast(underflow);
  const Vector below = Lanes::broadcast(0) - bound;
  const Points bc = cross(b, c), ad = cross(a, d);
  const Sign signs[4] = {
      sign_of(dot(bc, d), bound, below), sign_of(Lanes::broadcast(0) - dot(bc, a), bound, below),
      sign_of(Lanes::broadcast(0) - dot(ad, b), bound, below), sign_of(dot(ad, c), bound, below)};
  return (signs[0].plus & signs[1].plus & signs[2].plus & signs[3].plus) |
         (signs[0].minus & signs[1].minus & signs[2].minus & signs[3].minus);
}

// The portal search: a triangle of the difference's boundary that the ray from an inner point through
// the origin pierces is sought first, then moved outward.
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Proven hull_shape(const Triangles& t, const LaneConvex& convex,
                                                      unsigned wanted) {
  const Vector zero = Lanes::broadcast(0);
  const Points origin = {zero, zero, zero};
  const Points mean =
      times(plus(plus(t.corner[0], t.corner[1]), t.corner[2]), Lanes::broadcast(1.0 / 3));
  const Points inner =
      minus({Lanes::broadcast(convex.centre[0]), Lanes::broadcast(convex.centre[1]),
             Lanes::broadcast(convex.centre[2])},
            mean);
  Proven proven;
  // The triangle's plane parts most of what is near.
  const Points normal = cross(t.edge[0], t.edge[1]);
  const auto behind = Lanes::less(zero, dot(normal, inner));
  furthest(t, convex, select(behind, minus(origin, normal), normal), proven.no);
  if ((wanted & ~proven.no) == 0) return proven;
  Points a = furthest(t, convex, minus(origin, inner), proven.no);
  if ((wanted & ~proven.no) == 0) return proven;
  Points b = furthest(t, convex, cross(a, inner), proven.no);
  Points d = cross(minus(a, inner), minus(b, inner));
  const auto flip = Lanes::less(zero, dot(d, inner));
  const Points kept = a;
  a = select(flip, b, a);
  b = select(flip, kept, b);
  d = select(flip, minus(origin, d), d);
  Points c = b;
  unsigned found = 0;  // lanes with a portal
  for (int step = 0; step < most_supports; ++step) {
    const unsigned open = wanted & ~(proven.no | proven.yes);
    if (open == 0) break;
    const Points next = furthest(t, convex, d, proven.no);
    const Points turned = cross(next, inner);
    const unsigned of_a = above(dot(a, turned), zero), of_b = above(dot(b, turned), zero),
                   of_c = above(dot(c, turned), zero);
    // Without a portal: the origin is outside of the side planes of a and next, or of next and b.
    const unsigned beside_a = above(zero, dot(a, turned)) & ~found;
    const unsigned beside_b = of_b & ~beside_a & ~found;
    const unsigned new_portal = ~found & ~(beside_a | beside_b);
    // With one: `next` replaces the corner whose side is away from the ray.
    const unsigned in_place_of_a = found & ((of_a & of_b) | (~of_a & ~of_c));
    const unsigned in_place_of_c = found & of_a & ~of_b;
    const unsigned in_place_of_b = found & ~of_a & of_c;
    a = select(Lanes::from_bits((in_place_of_a | beside_b) & lane_bits), next, a);
    b = select(Lanes::from_bits((in_place_of_b | beside_a) & lane_bits), next, b);
    c = select(Lanes::from_bits((in_place_of_c | new_portal) & lane_bits), next, c);
    found |= new_portal;
    proven.yes |= surely_encloses(t, inner, a, b, c) & found & ~proven.no;
    const Points side = cross(minus(a, inner), minus(b, inner));
    const Points front = cross(minus(b, a), minus(c, a));
    d = select(Lanes::from_bits(found & lane_bits), front, side);
  }
  return proven;
}

TOUCHSTONE_TARGET TOUCHSTONE_FLATTEN inline LaneVerdicts compare_block(const LaneConvex& convex,
                                                                       const TriangleBlock& block,
                                                                       unsigned wanted,
                                                                       double error) {
  LaneVerdicts all;
  for (std::size_t at = 0; at < TriangleBlock::size; at += Lanes::width) {
    unsigned open = wanted >> at & lane_bits;
    if (open == 0) continue;
    Triangles t;
    for (std::size_t k = 0; k < 3; ++k) t.corner[k] = points_at(block, k, at);
    t.low = least(least(t.corner[0], t.corner[1]), t.corner[2]);
    t.high = greatest(greatest(t.corner[0], t.corner[1]), t.corner[2]);
    t.greatest = Lanes::max(Lanes::max(greatest_magnitude(t.low), greatest_magnitude(t.high)),
                            Lanes::broadcast(convex.reach));
    t.slack = Lanes::broadcast(4 * error) + Lanes::broadcast(64 * u) * t.greatest;
    open &= ~apart_from_box(t, convex);
    if (open == 0) continue;
    for (int k = 0; k < 3; ++k) t.edge[k] = minus(t.corner[k == 2 ? 0 : k + 1], t.corner[k]);
    Proven proven;
    switch (convex.kind) {
      case ShapeKind::sphere: proven = round_shape<true>(t, convex); break;
      case ShapeKind::capsule: proven = round_shape<false>(t, convex); break;
      case ShapeKind::box: proven = box_shape(t, convex); break;
      case ShapeKind::hull: proven = hull_shape(t, convex, open); break;
      default: break;
    }
    all.yes |= (open & proven.yes) << at;
    all.open |= (open & ~(proven.yes | proven.no)) << at;
  }
  return all;
}
