// The distance of boxes that are apart, for box_pair_lanes.h: points of faces, edges and corners.
// box_pair_lanes.inl includes this file.
//
// The square of the distance from a point of b to a is minimised along one edge of b after another,
// each time to the end. Which coordinates of both points are at their ends is right after a few
// rounds, and with it the rest, unless several edges are almost parallel. The plane across the line
// of the points then proves the distance.
template <class Scalar>
struct NearestPoints {
  using Vector = typename Simd<Scalar>::Vector;
  Vector at_b[3];          // coordinates along the edges of b, from its centre
  Vector from[3], out[3];  // the same point in the axes of a, and how far it is outside of a
};

// Computes `out` from `from`.
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void measure_outside(const BoxProducts<Scalar>& seen,
                                                         NearestPoints<Scalar>& points) {
  using Lanes = Simd<Scalar>;
  for (int k = 0; k < 3; ++k) {
    points.out[k] =
        points.from[k] - Lanes::min(Lanes::max(points.from[k], -seen.half_a[k]), seen.half_a[k]);
  }
}
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void place_on_b(const BoxProducts<Scalar>& seen,
                                                    NearestPoints<Scalar>& points) {
  const auto& p = seen.products;
  for (int k = 0; k < 3; ++k) {
    points.from[k] = seen.offset_a[k] + (p[k][0] * points.at_b[0] + p[k][1] * points.at_b[1] +
                                         p[k][2] * points.at_b[2]);
  }
  measure_outside<Scalar>(seen, points);
}

// The way along edge j of b to the least distance from a, if the point stays outside of a on the
// axes on which it is so.
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE typename Simd<Scalar>::Vector way_along(
    const BoxProducts<Scalar>& seen, const typename Simd<Scalar>::Vector out[3], int j) {
  using Lanes = Simd<Scalar>;
  using Vector = typename Lanes::Vector;
  const Vector zero = Lanes::broadcast(0);
  Vector slope = zero, curvature = zero;
  for (int k = 0; k < 3; ++k) {
    const Vector p = seen.products[k][j];
    const auto outside = Lanes::less(zero, Lanes::abs(out[k]));
    slope = slope + out[k] * p;
    curvature = curvature + Lanes::select(outside, p * p, zero);
  }
  // An edge that is parallel to what it is near to has no best place.
  const Vector least = Lanes::broadcast(GapError<Scalar>::parallel_edge);
  return Lanes::select(Lanes::less(least, curvature), -slope / Lanes::max(curvature, least), zero);
}

// Computes the axis with the greatest gap, from a to b in the axes of a, of any length.
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void widest_axis(const BoxProducts<Scalar>& seen,
                                                     typename Simd<Scalar>::Vector axis[3]) {
  using Lanes = Simd<Scalar>;
  using Vector = typename Lanes::Vector;
  const Vector zero = Lanes::broadcast(0), one = Lanes::broadcast(1);
  const auto& p = seen.products;
  Vector greatest = seen.face_gaps[0];
  for (int k = 0; k < 3; ++k) axis[k] = k == 0 ? one : zero;
  for (int face = 1; face < 6; ++face) {
    const auto wider = Lanes::less(greatest, seen.face_gaps[face]);
    greatest = Lanes::max(seen.face_gaps[face], greatest);
    for (int k = 0; k < 3; ++k) {
      const Vector along = face >= 3 ? p[k][face - 3] : face == k ? one : zero;
      axis[k] = Lanes::select(wider, along, axis[k]);
    }
  }
  // Squares with the sign of the gap.
  Vector measure = greatest * Lanes::abs(greatest), square = one;
  for (int i = 0; i < 3; ++i) {
    EdgeAxis<Scalar> axes[3];
    edge_axes<Scalar>(seen, i, axes);
    for (const EdgeAxis<Scalar>& edges : axes) {
      const Vector own_square = square_length<Scalar>(edges);
      const Vector own_measure = edges.gap * Lanes::abs(edges.gap);
      const auto wider = both(Lanes::less(Lanes::broadcast(GapError<Scalar>::parallel), own_square),
                              Lanes::less(measure * own_square, own_measure * square));
      measure = Lanes::select(wider, own_measure, measure);
      square = Lanes::select(wider, own_square, square);
      axis[i] = Lanes::select(wider, zero, axis[i]);
      axis[(i + 1) % 3] = Lanes::select(wider, edges.first, axis[(i + 1) % 3]);
      axis[(i + 2) % 3] = Lanes::select(wider, edges.second, axis[(i + 2) % 3]);
    }
  }
  const Vector along =
      axis[0] * seen.offset_a[0] + axis[1] * seen.offset_a[1] + axis[2] * seen.offset_a[2];
  const Vector side = Lanes::select(Lanes::less(along, zero), -one, one);
  for (int k = 0; k < 3; ++k) axis[k] = side * axis[k];
}

// Starts where the features are that face each other along the axis with the greatest gap: two
// edges, or a corner and a face, have their nearest points there.
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void start_at_features(const BoxProducts<Scalar>& seen,
                                                           NearestPoints<Scalar>& points) {
  using Lanes = Simd<Scalar>;
  using Vector = typename Lanes::Vector;
  const Vector zero = Lanes::broadcast(0);
  const auto& p = seen.products;
  const auto clamp = [](Vector x, Vector half)
                         TOUCHSTONE_TARGET { return Lanes::min(Lanes::max(x, -half), half); };
  // The end at which the feature is, if the coordinate changes the height; else the place.
  const Vector room = GapError<Scalar>::room * seen.size;
  const auto placed = [&](Vector lean, Vector half, Vector place) TOUCHSTONE_TARGET {
    const Vector reach = lean * half;
    const Vector low = Lanes::select(Lanes::less(reach, -room), -half, clamp(place, half));
    return Lanes::select(Lanes::less(room, reach), half, low);
  };
  Vector axis[3], on_a[3];
  widest_axis<Scalar>(seen, axis);
  for (int k = 0; k < 3; ++k) on_a[k] = placed(axis[k], seen.half_a[k], seen.offset_a[k]);
  Vector lean[3];
  for (int j = 0; j < 3; ++j) {
    lean[j] = axis[0] * p[0][j] + axis[1] * p[1][j] + axis[2] * p[2][j];
    const Vector place =
        (on_a[0] * p[0][j] + on_a[1] * p[1][j] + on_a[2] * p[2][j]) - seen.offset_b[j];
    points.at_b[j] = placed(-lean[j], seen.half_b[j], place);
  }
  place_on_b<Scalar>(seen, points);
  // Edges: the place where the lines are nearest.
  for (int j = 0; j < 3; ++j) {
    Vector between[3];
    for (int k = 0; k < 3; ++k) {
      const auto fixed = Lanes::less(room, Lanes::abs(axis[k] * seen.half_a[k]));
      between[k] = Lanes::select(fixed, points.from[k] - on_a[k], zero);
    }
    const auto free = Lanes::less(Lanes::abs(lean[j] * seen.half_b[j]), room);
    const Vector way = Lanes::select(free, way_along<Scalar>(seen, between, j), zero);
    points.at_b[j] = clamp(points.at_b[j] + way, seen.half_b[j]);
  }
  place_on_b<Scalar>(seen, points);
}

template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void find_nearest(const BoxProducts<Scalar>& seen,
                                                      unsigned lanes,
                                                      NearestPoints<Scalar>& points) {
  using Lanes = Simd<Scalar>;
  using Vector = typename Lanes::Vector;
  constexpr int most_rounds = 8;
  const Vector enough = GapError<Scalar>::room * seen.size;
  start_at_features<Scalar>(seen, points);
  // A lane ends where its point does not move any more, whatever the other lanes need.
  unsigned ended = 0;
  for (int round = 0; round < most_rounds; ++round) {
    const auto stays = Lanes::from_bits(ended);
    Vector moved = Lanes::broadcast(0);
    for (int j = 0; j < 3; ++j) {
      const Vector half = seen.half_b[j];
      const Vector next = Lanes::min(
          Lanes::max(points.at_b[j] + way_along<Scalar>(seen, points.out, j), -half), half);
      const Vector way = Lanes::select(stays, Lanes::broadcast(0), next - points.at_b[j]);
      moved = Lanes::max_abs(moved, way);
      points.at_b[j] = Lanes::select(stays, points.at_b[j], next);
      for (int k = 0; k < 3; ++k) points.from[k] = points.from[k] + seen.products[k][j] * way;
      measure_outside<Scalar>(seen, points);
    }
    ended |= ~Lanes::to_bits(Lanes::less(enough, moved));
    if ((lanes & ~ended) == 0) break;
  }
  place_on_b<Scalar>(seen, points);
}

// Writes the distances of lanes that are apart; returns the lanes for which the plane and the points
// agree. It is not inlined, so that both loops share one copy.
template <class Scalar>
[[gnu::noinline]] TOUCHSTONE_TARGET unsigned write_distances(const PairTable<Scalar>& table,
                                                             std::size_t begin,
                                                             const BoxColumns<Scalar>& boxes,
                                                             const BoxProducts<Scalar>& seen,
                                                             unsigned lanes) {
  using Lanes = Simd<Scalar>;
  using Vector = typename Lanes::Vector;
  const Vector zero = Lanes::broadcast(0);
  NearestPoints<Scalar> points;
  find_nearest<Scalar>(seen, lanes, points);
  Vector at_a[3];
  for (int k = 0; k < 3; ++k) at_a[k] = points.from[k] - points.out[k];
  for (int k = 0; k < 3; ++k) {
    at_a[k] = Lanes::min(Lanes::max(at_a[k], -seen.half_a[k]), seen.half_a[k]);
  }
  const Vector3<Scalar> on_a = to_world<Scalar>(boxes.a, at_a);
  const Vector3<Scalar> on_b = sum<Scalar>(boxes.offset, to_world<Scalar>(boxes.b, points.at_b));
  const Vector3<Scalar> between = difference<Scalar>(on_b, on_a);
  // The line of points that are near each other has lost digits. It is made perpendicular to the
  // edges of b along which the point is free; to those of a it is.
  for (int j = 0; j < 3; ++j) {
    const auto is_free = Lanes::less(Lanes::abs(points.at_b[j]), seen.half_b[j]);
    const Vector way = Lanes::select(is_free, way_along<Scalar>(seen, points.out, j), zero);
    for (int k = 0; k < 3; ++k) {
      const auto outside = Lanes::less(zero, Lanes::abs(points.out[k]));
      points.out[k] =
          Lanes::select(outside, points.out[k] + way * seen.products[k][j], points.out[k]);
    }
  }
  const Vector3<Scalar> along = to_world<Scalar>(boxes.a, points.out);
  const Vector length = Lanes::sqrt(dot<Scalar>(along, along));
  Vector reach = zero;
  for (int k = 0; k < 3; ++k) {
    reach = reach + (seen.half_a[k] * Lanes::abs(dot<Scalar>(along, boxes.a[k])) +
                     seen.half_b[k] * Lanes::abs(dot<Scalar>(along, boxes.b[k])));
  }
  const Vector inverse = Lanes::broadcast(1) / length;
  const Vector gap = (dot<Scalar>(along, boxes.offset) - reach) * inverse;
  const Vector distance = Lanes::sqrt(dot<Scalar>(between, between));
  const Vector error = GapError<Scalar>::distance * seen.size;
  lanes &= Lanes::to_bits(Lanes::less(error, gap)) &
           Lanes::to_bits(Lanes::less(distance - gap, 2 * error));
  write_numbers<Scalar>(
      table, begin, lanes,
      {distance, gap - error, distance + error, scaled<Scalar>(inverse, along), on_a, on_b});
  return lanes;
}
