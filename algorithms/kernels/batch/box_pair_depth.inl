// The depths of box_pair_lanes.h: axis of least penetration, normal and witness points.
// box_pair_lanes.inl includes this file.

// The axis of a lane's least depth: a product of edges, by their numbers, or a face normal of the
// box whose number is not negative. The gap is multiplied by the axis' length.
template <class Scalar>
struct LeastAxis {
  using Vector = typename Simd<Scalar>::Vector;
  Vector gap, square;  // square of the axis' length
  Vector measure;      // (gap / size)^2, lowered for a face
  Vector edge_a, edge_b;
};

// The measure of a face is lowered by more than rounding: edges perpendicular to a face have the
// face's axis, and the face has the better witness points.
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE LeastAxis<Scalar> least_face(
    const BoxProducts<Scalar>& seen, typename Simd<Scalar>::Vector inverse_size) {
  using Lanes = Simd<Scalar>;
  using Vector = typename Lanes::Vector;
  constexpr Scalar as_good = 1 - 64 * GapError<Scalar>::u;
  const Vector none = Lanes::broadcast(-1);
  Vector greatest = seen.face_gaps[0], edge_a = Lanes::broadcast(0), edge_b = none;
  for (int k = 1; k < 6; ++k) {
    const auto better = Lanes::less(greatest, seen.face_gaps[k]);
    const Vector number = Lanes::broadcast(static_cast<Scalar>(k % 3));
    greatest = Lanes::max(seen.face_gaps[k], greatest);
    edge_a = Lanes::select(better, k < 3 ? number : none, edge_a);
    if (k >= 3) edge_b = Lanes::select(better, number, edge_b);
  }
  const Vector part = greatest * inverse_size;
  return {greatest, Lanes::broadcast(1), as_good * part * part, edge_a, edge_b};
}

// Takes the axis of edges i and j in the lanes where its depth is less. Nothing here leaves the
// scalar's range: in lanes that overlap no gap that counts is below 4 u 160 u of the size.
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void take_less(const EdgeAxis<Scalar>& axis, int i, int j,
                                                   typename Simd<Scalar>::Vector inverse_size,
                                                   LeastAxis<Scalar>& least) {
  using Lanes = Simd<Scalar>;
  using Vector = typename Lanes::Vector;
  const Vector square = square_length<Scalar>(axis);
  const auto parallel = Lanes::less(square, Lanes::broadcast(GapError<Scalar>::parallel));
  const Vector counted = Lanes::select(parallel, Lanes::broadcast(0), square);
  const Vector part = axis.gap * inverse_size, measure = part * part;
  const auto better = Lanes::less(measure * least.square, least.measure * counted);
  least.gap = Lanes::select(better, axis.gap, least.gap);
  least.square = Lanes::select(better, square, least.square);
  least.measure = Lanes::select(better, measure, least.measure);
  least.edge_a = Lanes::select(better, Lanes::broadcast(static_cast<Scalar>(i)), least.edge_a);
  least.edge_b = Lanes::select(better, Lanes::broadcast(static_cast<Scalar>(j)), least.edge_b);
}

// Finds the axis of least depth for lanes that overlap. Also marks open lanes as overlapping if
// their depth along all axes is at least twice what `fine` allows for.
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE LeastAxis<Scalar> least_axis(const BoxProducts<Scalar>& seen,
                                                                 Signs& signs) {
  using Lanes = Simd<Scalar>;
  using Vector = typename Lanes::Vector;
  const Vector inverse_size = Lanes::broadcast(1) / seen.size;
  LeastAxis<Scalar> least = least_face<Scalar>(seen, inverse_size);
  Vector greatest = seen.face_gap;
  for (int i = 0; i < 3; ++i) {
    EdgeAxis<Scalar> axes[3];
    edge_axes<Scalar>(seen, i, axes);
    for (int j = 0; j < 3; ++j) {
      greatest = Lanes::max(greatest, axes[j].gap);
      take_less<Scalar>(axes[j], i, j, inverse_size, least);
    }
  }
  constexpr Scalar sure = 2 * GapError<Scalar>::fine;
  signs.overlapping |= signs.open() & Lanes::to_bits(Lanes::less(greatest, Lanes::broadcast(0))) &
                       Lanes::to_bits(Lanes::less(sure * sure * least.square, least.measure));
  return least;
}

// Returns the one of the three vectors whose number it is.
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE typename Simd<Scalar>::Vector pick(
    typename Simd<Scalar>::Vector number, typename Simd<Scalar>::Vector zero,
    typename Simd<Scalar>::Vector one, typename Simd<Scalar>::Vector two) {
  using Lanes = Simd<Scalar>;
  const auto below_two = Lanes::less(number, Lanes::broadcast(Scalar(1.5)));
  const auto below_one = Lanes::less(number, Lanes::broadcast(Scalar(0.5)));
  return Lanes::select(below_one, zero, Lanes::select(below_two, one, two));
}

// Coordinates along the edges of a, from its centre. The points are those of least penetration.
template <class Scalar>
struct Contact {
  using Vector = typename Simd<Scalar>::Vector;
  Vector depth, normal[3], on_a[3], on_b[3];
};

// Returns the lanes whose points are on their boxes.
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE unsigned on_boxes(const BoxProducts<Scalar>& seen,
                                                      const Contact<Scalar>& contact) {
  using Lanes = Simd<Scalar>;
  using Vector = typename Lanes::Vector;
  const auto& p = seen.products;
  const Vector room = GapError<Scalar>::coarse * seen.size;
  Vector outside = Lanes::broadcast(-1);
  for (int k = 0; k < 3; ++k) {
    outside = Lanes::max(outside, Lanes::abs(contact.on_a[k]) - seen.half_a[k]);
    const Vector along = (contact.on_b[0] - seen.offset_a[0]) * p[0][k] +
                         (contact.on_b[1] - seen.offset_a[1]) * p[1][k] +
                         (contact.on_b[2] - seen.offset_a[2]) * p[2][k];
    outside = Lanes::max(outside, Lanes::abs(along) - seen.half_b[k]);
  }
  return Lanes::to_bits(Lanes::less(outside, room));
}

// Moves the points together: if a face meets a feature that is parallel to it up to rounding, any
// corner may lie beside it. Alternating projections on the features of a and b converge to points
// of both.
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void slide_together(const BoxProducts<Scalar>& seen,
                                                        Contact<Scalar>& contact) {
  using Lanes = Simd<Scalar>;
  using Vector = typename Lanes::Vector;
  constexpr int rounds = 8;
  const auto& p = seen.products;
  const Vector zero = Lanes::broadcast(0);
  const Vector room = GapError<Scalar>::coarse * seen.size;
  const auto clamp = [](Vector x, Vector low, Vector high)
                         TOUCHSTONE_TARGET { return Lanes::min(Lanes::max(x, low), high); };
  // Bounds of the coordinates along each box's edges on its feature.
  Vector low_a[3], high_a[3], low_b[3], high_b[3];
  for (int k = 0; k < 3; ++k) {
    const Vector along =
        contact.normal[0] * p[0][k] + contact.normal[1] * p[1][k] + contact.normal[2] * p[2][k];
    const Vector a = contact.normal[k], half_a = seen.half_a[k], half_b = seen.half_b[k];
    low_a[k] = Lanes::select(Lanes::less(room, half_a * a), half_a, -half_a);
    high_a[k] = Lanes::select(Lanes::less(half_a * a, -room), -half_a, half_a);
    low_b[k] = Lanes::select(Lanes::less(half_b * along, -room), half_b, -half_b);
    high_b[k] = Lanes::select(Lanes::less(room, half_b * along), -half_b, half_b);
  }
  Vector at_a[3];
  for (int k = 0; k < 3; ++k) at_a[k] = clamp(zero, low_a[k], high_a[k]);
  for (int round = 0; round < rounds; ++round) {
    Vector from[3];
    for (int k = 0; k < 3; ++k) {
      from[k] = at_a[k] - contact.depth * contact.normal[k] - seen.offset_a[k];
      contact.on_b[k] = seen.offset_a[k];
    }
    for (int k = 0; k < 3; ++k) {
      const Vector along =
          clamp(from[0] * p[0][k] + from[1] * p[1][k] + from[2] * p[2][k], low_b[k], high_b[k]);
      for (int axis = 0; axis < 3; ++axis) contact.on_b[axis] += along * p[axis][k];
    }
    for (int k = 0; k < 3; ++k) {
      contact.on_a[k] = contact.on_b[k] + contact.depth * contact.normal[k];
      at_a[k] = clamp(contact.on_a[k], low_a[k], high_a[k]);
    }
  }
}

// Finds the contacts of the lanes that overlap; returns the lanes whose points were found.
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE unsigned find_contacts(const BoxProducts<Scalar>& seen,
                                                           const LeastAxis<Scalar>& least,
                                                           unsigned overlapping,
                                                           Contact<Scalar>& contact) {
  using Lanes = Simd<Scalar>;
  using Vector = typename Lanes::Vector;
  const Vector zero = Lanes::broadcast(0), one = Lanes::broadcast(1);
  const auto face_a = Lanes::less(least.edge_b, zero), face_b = Lanes::less(least.edge_a, zero);
  const auto& p = seen.products;
  auto& [depth, normal, on_a, on_b] = contact;
  Vector edge_a[3], edge_b[3];
  for (int k = 0; k < 3; ++k) {
    edge_a[k] =
        pick<Scalar>(least.edge_a, k == 0 ? one : zero, k == 1 ? one : zero, k == 2 ? one : zero);
    edge_b[k] = pick<Scalar>(least.edge_b, p[k][0], p[k][1], p[k][2]);
  }
  for (int k = 0; k < 3; ++k) {
    const int k1 = (k + 1) % 3, k2 = (k + 2) % 3;
    const Vector across = edge_a[k1] * edge_b[k2] - edge_a[k2] * edge_b[k1];
    normal[k] = Lanes::select(face_a, edge_a[k], Lanes::select(face_b, edge_b[k], across));
  }
  const Vector square = normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2];
  const Vector between =
      normal[0] * seen.offset_a[0] + normal[1] * seen.offset_a[1] + normal[2] * seen.offset_a[2];
  const Vector edges = Lanes::select(face_a, zero, Lanes::select(face_b, zero, one));
  const auto is_edges = Lanes::less(zero, edges);
  Vector inverse = one / Lanes::sqrt(square);
  depth = -least.gap * Lanes::select(is_edges, inverse, one);
  const Vector inverse_square = inverse * inverse;
  inverse = Lanes::select(Lanes::less(between, zero), -inverse, inverse);
  for (Vector& x : normal) x = x * inverse;

  // Each box's corner deepest in the other; of two edges, their middles.
  for (int k = 0; k < 3; ++k) {
    const Vector half = seen.half_a[k] - seen.half_a[k] * edges * edge_a[k];
    on_a[k] = Lanes::select(Lanes::less(normal[k], zero), -half, half);
    on_b[k] = seen.offset_a[k];
  }
  for (int j = 0; j < 3; ++j) {
    const Vector along = normal[0] * p[0][j] + normal[1] * p[1][j] + normal[2] * p[2][j];
    const Vector free = pick<Scalar>(least.edge_b, j == 0 ? edges : zero, j == 1 ? edges : zero,
                                     j == 2 ? edges : zero);
    const Vector half = seen.half_b[j] - seen.half_b[j] * free;
    const Vector reach = Lanes::select(Lanes::less(along, zero), half, -half);
    for (int k = 0; k < 3; ++k) on_b[k] += reach * p[k][j];
  }
  // Moves from the middles to where the lines of two edges are closest. The part of edge b that is
  // perpendicular to edge a is taken by coordinate, and so keeps its digits if they are almost
  // parallel.
  Vector slide_b = zero, slide_a = zero, cosine = zero;
  for (int k = 0; k < 3; ++k) {
    const Vector from_a = on_b[k] - on_a[k];
    slide_b -= from_a * Lanes::select(Lanes::less(zero, edge_a[k]), zero, edge_b[k]);
    slide_a += from_a * edge_a[k];
    cosine += edge_a[k] * edge_b[k];
  }
  slide_b = Lanes::select(is_edges, slide_b * inverse_square, zero);
  slide_a = Lanes::select(is_edges, slide_a + slide_b * cosine, zero);
  for (int k = 0; k < 3; ++k) {
    on_a[k] += slide_a * edge_a[k];
    on_b[k] += slide_b * edge_b[k];
    const Vector apart = depth * normal[k];
    const Vector moved_a = on_b[k] + apart, moved_b = on_a[k] - apart;
    on_a[k] = Lanes::select(face_a, moved_a, on_a[k]);
    on_b[k] = Lanes::select(face_b, moved_b, on_b[k]);
  }

  unsigned good = on_boxes<Scalar>(seen, contact);
  if ((overlapping & ~good) == 0) return overlapping;
  Contact<Scalar> slid = contact;
  slide_together<Scalar>(seen, slid);
  const auto accepted = Lanes::from_bits(good);
  for (int k = 0; k < 3; ++k) {
    on_a[k] = Lanes::select(accepted, on_a[k], slid.on_a[k]);
    on_b[k] = Lanes::select(accepted, on_b[k], slid.on_b[k]);
  }
  good |= on_boxes<Scalar>(seen, slid);
  return overlapping & good;
}

template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Vector3<Scalar> to_world(
    const Vector3<Scalar> columns[3], const typename Simd<Scalar>::Vector v[3]) {
  return {columns[0].x * v[0] + columns[1].x * v[1] + columns[2].x * v[2],
          columns[0].y * v[0] + columns[1].y * v[1] + columns[2].y * v[2],
          columns[0].z * v[0] + columns[1].z * v[1] + columns[2].z * v[2]};
}

template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Vector3<Scalar> sum(const Vector3<Scalar>& a,
                                                        const Vector3<Scalar>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

// Writes all numbers of the outcomes of the lanes that overlap; returns the lanes for which this
// was possible.
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE unsigned write_depths(
    const PairTable<Scalar>& table, std::size_t begin, const BoxColumns<Scalar>& boxes,
    const BoxProducts<Scalar>& seen, const LeastAxis<Scalar>& least, unsigned overlapping) {
  using Lanes = Simd<Scalar>;
  using Vector = typename Lanes::Vector;
  Contact<Scalar> contact;
  overlapping = find_contacts<Scalar>(seen, least, overlapping, contact);
  const Vector3<Scalar> normal = to_world<Scalar>(boxes.a, contact.normal);
  const Vector3<Scalar> on_a = to_world<Scalar>(boxes.a, contact.on_a);
  const Vector3<Scalar> on_b = to_world<Scalar>(boxes.a, contact.on_b);
  // One axis suffices for the lower bound of the signed distance, since its depth is at least the
  // least; the upper bound needs all axes.
  const Vector lower = -contact.depth - GapError<Scalar>::coarse * seen.size;
  const Vector upper = GapError<Scalar>::fine * seen.size - contact.depth;
  write_numbers<Scalar>(table, begin, overlapping,
                        {-contact.depth, lower, upper, normal, on_a, on_b});
  return overlapping;
}
