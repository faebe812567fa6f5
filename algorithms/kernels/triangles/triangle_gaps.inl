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

TOUCHSTONE_TARGET TOUCHSTONE_INLINE Points times(const Points& p, Vector by) {
  return {p.x * by, p.y * by, p.z * by};
}
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Vector clamped(Vector x) {
  return Lanes::min(Lanes::max(x, Lanes::broadcast(0)), Lanes::broadcast(1));
}

// The shortest way from a to b that was found. NaN never replaces it.
struct Shortest {
  Points way;
  Vector square;

  TOUCHSTONE_TARGET TOUCHSTONE_INLINE void consider(const Points& other, Vector other_square) {
    const auto shorter = Lanes::less(other_square, square);
    way = {Lanes::select(shorter, other.x, way.x), Lanes::select(shorter, other.y, way.y),
           Lanes::select(shorter, other.z, way.z)};
    square = Lanes::select(shorter, other_square, square);
  }
};

// A triangle with its edges; edge k leads from corner k.
struct Edged {
  Points corner[3], edge[3];
  Vector square[3], inverse[3];  // of the edges' lengths

  TOUCHSTONE_TARGET TOUCHSTONE_INLINE void complete() {
    for (int k = 0; k < 3; ++k) {
      edge[k] = minus(corner[k == 2 ? 0 : k + 1], corner[k]);
      square[k] = dot(edge[k], edge[k]);
      inverse[k] = Lanes::broadcast(1) / square[k];
    }
  }
};

// The nearest points of edge i of a and edge j of b: of their lines, with one clamped to its edge
// and the other to its own after that.
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void consider_edges(const Edged& a, int i, const Edged& b,
                                                        int j, Shortest& shortest) {
  const Vector zero = Lanes::broadcast(0);
  const Points &u = a.edge[i], &v = b.edge[j];
  const Points between = minus(a.corner[i], b.corner[j]);
  const Vector f = dot(v, between), c = dot(u, between), both = dot(u, v);
  const Vector denominator = a.square[i] * b.square[j] - both * both;
  Vector s = clamped((both * f - c * b.square[j]) / denominator);
  s = Lanes::select(Lanes::less(zero, denominator), s, zero);
  const Vector t = clamped((both * s + f) * b.inverse[j]);
  s = clamped((both * t - c) * a.inverse[i]);
  const Points on_u = times(u, s), on_v = times(v, t);
  const Points way = {on_v.x - on_u.x - between.x, on_v.y - on_u.y - between.y,
                      on_v.z - on_u.z - between.z};
  shortest.consider(way, dot(way, way));
}

// Corners of `other` over the face; `sense` is 1 if the face is a's, else -1.
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void consider_face(const Edged& face, const Edged& other,
                                                       double sense, Shortest& shortest) {
  const Vector zero = Lanes::broadcast(0);
  const Vector beyond = Lanes::broadcast(std::numeric_limits<double>::infinity());
  const Points normal = cross(face.edge[0], face.edge[1]);
  const Points inward[3] = {cross(normal, face.edge[0]), cross(normal, face.edge[1]),
                            cross(normal, face.edge[2])};
  const Vector inverse = Lanes::broadcast(1) / dot(normal, normal);
  for (int k = 0; k < 3; ++k) {
    const Vector height = dot(normal, minus(other.corner[k], face.corner[0]));
    Vector least_side = dot(inward[0], minus(other.corner[k], face.corner[0]));
    for (int j = 1; j < 3; ++j) {
      least_side = Lanes::min(least_side, dot(inward[j], minus(other.corner[k], face.corner[j])));
    }
    const Vector square =
        Lanes::select(Lanes::less_equal(zero, least_side), height * height * inverse, beyond);
    shortest.consider(times(normal, height * inverse * Lanes::broadcast(sense)), square);
  }
}

TOUCHSTONE_TARGET TOUCHSTONE_FLATTEN inline void gap_lanes(
    const TriangleBlock& block_a, const TriangleBlock& block_b,
    std::array<double, TriangleBlock::size>& gap) {
  for (std::size_t at = 0; at < TriangleBlock::size; at += Lanes::width) {
    Edged a, b;
    const Points origin = points_at(block_a, 0, at);
    for (std::size_t k = 0; k < 3; ++k) {
      a.corner[k] = minus(points_at(block_a, k, at), origin);
      b.corner[k] = minus(points_at(block_b, k, at), origin);
    }
    a.complete();
    b.complete();
    Shortest shortest = {minus(b.corner[0], a.corner[0]), Lanes::broadcast(0)};
    shortest.square = dot(shortest.way, shortest.way);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) consider_edges(a, i, b, j, shortest);
    }
    consider_face(a, b, 1, shortest);
    consider_face(b, a, -1, shortest);

    const Points& way = shortest.way;
    const Vector end =
        Lanes::max(Lanes::max(dot(way, a.corner[0]), dot(way, a.corner[1])), dot(way, a.corner[2]));
    const Vector begin =
        Lanes::min(Lanes::min(dot(way, b.corner[0]), dot(way, b.corner[1])), dot(way, b.corner[2]));
    const Vector square = dot(way, way);
    // The root of a smaller square is no length.
    const auto known = Lanes::less(Lanes::broadcast(1e-280), square);
    Lanes::store(&gap[at],
                 Lanes::select(known, (begin - end) / Lanes::sqrt(square), Lanes::broadcast(-1)));
  }
}
