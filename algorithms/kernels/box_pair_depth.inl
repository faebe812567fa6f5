// The depths of box_pair_lanes.h: axis of least penetration, normal and witness points. Included by
// box_pair_lanes.inl.

// What a lane's least depth is along: a product of edges, by their numbers, or a face normal of
// that box whose number is not below zero.
template <class Scalar>
struct LeastAxis {
  typename RealLanes<Scalar>::Real square;  // of the depth
  typename RealLanes<Scalar>::Real edge_a, edge_b;
};

template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE LeastAxis<Scalar> least_axis(const BoxProducts<Scalar>& seen) {
  using Lanes = RealLanes<Scalar>;
  using Real = typename Lanes::Real;
  const Real none = Lanes::broadcast(-1);
  const Real numbers[3] = {Lanes::broadcast(0), Lanes::broadcast(1), Lanes::broadcast(2)};
  LeastAxis<Scalar> least{none, none, none};
  Real greatest = seen.face_gaps[0];
  for (int k = 0; k < 6; ++k) {
    const auto better = Lanes::less(greatest, seen.face_gaps[k]);
    greatest = Lanes::max(seen.face_gaps[k], greatest);
    if (k == 0) {
      least.edge_a = numbers[0];
    } else if (k < 3) {
      least.edge_a = Lanes::select(better, numbers[k], least.edge_a);
    } else {
      least.edge_a = Lanes::select(better, none, least.edge_a);
      least.edge_b = Lanes::select(better, numbers[k - 3], least.edge_b);
    }
  }
  least.square = greatest * greatest;
  // Less by more than rounding: where edges are square to a face their axis is the face's, which
  // has the better witness points. Edges that are parallel up to rounding have no axis.
  const Real as_good = Lanes::broadcast(1 - 64 * GapError<Scalar>::u);
  const Real parallel = Lanes::broadcast(16 * GapError<Scalar>::u * GapError<Scalar>::u);
  const Real infinite = Lanes::broadcast(std::numeric_limits<Scalar>::infinity());
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const EdgeAxis<Scalar> axis = edge_axis<Scalar>(seen, i, j);
      const Real length = axis.first * axis.first + axis.second * axis.second;
      // In this order nothing leaves the scalar's range.
      const Real square =
          Lanes::select(Lanes::less(length, parallel), infinite, axis.gap / length * axis.gap);
      const auto better = Lanes::less(square, least.square * as_good);
      least.square = Lanes::select(better, square, least.square);
      least.edge_a = Lanes::select(better, numbers[i], least.edge_a);
      least.edge_b = Lanes::select(better, numbers[j], least.edge_b);
    }
  }
  return least;
}

// Of three, the one whose number it is.
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE typename RealLanes<Scalar>::Real pick(
    typename RealLanes<Scalar>::Real number, typename RealLanes<Scalar>::Real zero,
    typename RealLanes<Scalar>::Real one, typename RealLanes<Scalar>::Real two) {
  using Lanes = RealLanes<Scalar>;
  const auto below_two = Lanes::less(number, Lanes::broadcast(Scalar(1.5)));
  const auto below_one = Lanes::less(number, Lanes::broadcast(Scalar(0.5)));
  return Lanes::select(below_one, zero, Lanes::select(below_two, one, two));
}

// Coordinates along the edges of a, from its centre. The points are those of least penetration.
template <class Scalar>
struct Contact {
  using Real = typename RealLanes<Scalar>::Real;
  Real depth, normal[3], on_a[3], on_b[3];
};

// The lanes whose points are on their boxes.
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE unsigned on_boxes(const BoxProducts<Scalar>& seen,
                                                      const Contact<Scalar>& contact) {
  using Lanes = RealLanes<Scalar>;
  using Real = typename Lanes::Real;
  const auto& p = seen.products;
  const Real room = GapError<Scalar>::coarse * seen.size;
  Real outside = Lanes::broadcast(-1);
  for (int k = 0; k < 3; ++k) {
    outside = Lanes::max(outside, Lanes::abs(contact.on_a[k]) - seen.half_a[k]);
    const Real along = (contact.on_b[0] - seen.offset_a[0]) * p[0][k] +
                       (contact.on_b[1] - seen.offset_a[1]) * p[1][k] +
                       (contact.on_b[2] - seen.offset_a[2]) * p[2][k];
    outside = Lanes::max(outside, Lanes::abs(along) - seen.half_b[k]);
  }
  return Lanes::bits(Lanes::less(outside, room));
}

// Where a face meets what is parallel to it up to rounding, any corner may lie beside it. Goes from
// the features of a to those of b and back, to the nearest point each time: these meet.
template <class Scalar>
TOUCHSTONE_TARGET void slide_together(const BoxProducts<Scalar>& seen, Contact<Scalar>& contact) {
  using Lanes = RealLanes<Scalar>;
  using Real = typename Lanes::Real;
  constexpr int rounds = 8;
  const auto& p = seen.products;
  const Real zero = Lanes::broadcast(0);
  const Real room = GapError<Scalar>::coarse * seen.size;
  const auto clamp = [](Real x, Real low, Real high)
                         TOUCHSTONE_TARGET { return Lanes::min(Lanes::max(x, low), high); };
  // Between what the boxes' coordinates along their edges may be on their features.
  Real low_a[3], high_a[3], low_b[3], high_b[3];
  for (int k = 0; k < 3; ++k) {
    const Real along =
        contact.normal[0] * p[0][k] + contact.normal[1] * p[1][k] + contact.normal[2] * p[2][k];
    const Real a = contact.normal[k], half_a = seen.half_a[k], half_b = seen.half_b[k];
    low_a[k] = Lanes::select(Lanes::less(room, half_a * a), half_a, -half_a);
    high_a[k] = Lanes::select(Lanes::less(half_a * a, -room), -half_a, half_a);
    low_b[k] = Lanes::select(Lanes::less(half_b * along, -room), half_b, -half_b);
    high_b[k] = Lanes::select(Lanes::less(room, half_b * along), -half_b, half_b);
  }
  Real at_a[3];
  for (int k = 0; k < 3; ++k) at_a[k] = clamp(zero, low_a[k], high_a[k]);
  for (int round = 0; round < rounds; ++round) {
    Real from[3];
    for (int k = 0; k < 3; ++k) {
      from[k] = at_a[k] - contact.depth * contact.normal[k] - seen.offset_a[k];
      contact.on_b[k] = seen.offset_a[k];
    }
    for (int k = 0; k < 3; ++k) {
      const Real along =
          clamp(from[0] * p[0][k] + from[1] * p[1][k] + from[2] * p[2][k], low_b[k], high_b[k]);
      for (int axis = 0; axis < 3; ++axis) contact.on_b[axis] += along * p[axis][k];
    }
    for (int k = 0; k < 3; ++k) {
      contact.on_a[k] = contact.on_b[k] + contact.depth * contact.normal[k];
      at_a[k] = clamp(contact.on_a[k], low_a[k], high_a[k]);
    }
  }
}

// The contacts of those lanes that are known to overlap; those of them whose points are found.
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE unsigned find_contacts(const BoxProducts<Scalar>& seen,
                                                           unsigned overlapping,
                                                           Contact<Scalar>& contact) {
  using Lanes = RealLanes<Scalar>;
  using Real = typename Lanes::Real;
  const LeastAxis<Scalar> least = least_axis<Scalar>(seen);
  const Real zero = Lanes::broadcast(0), one = Lanes::broadcast(1);
  const auto face_a = Lanes::less(least.edge_b, zero), face_b = Lanes::less(least.edge_a, zero);
  const auto& p = seen.products;
  auto& [depth, normal, on_a, on_b] = contact;
  depth = Lanes::sqrt(least.square);
  Real edge_a[3], edge_b[3];
  for (int k = 0; k < 3; ++k) {
    edge_a[k] =
        pick<Scalar>(least.edge_a, k == 0 ? one : zero, k == 1 ? one : zero, k == 2 ? one : zero);
    edge_b[k] = pick<Scalar>(least.edge_b, p[k][0], p[k][1], p[k][2]);
  }
  for (int k = 0; k < 3; ++k) {
    const int k1 = (k + 1) % 3, k2 = (k + 2) % 3;
    const Real across = edge_a[k1] * edge_b[k2] - edge_a[k2] * edge_b[k1];
    normal[k] = Lanes::select(face_a, edge_a[k], Lanes::select(face_b, edge_b[k], across));
  }
  const Real square = normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2];
  const Real between =
      normal[0] * seen.offset_a[0] + normal[1] * seen.offset_a[1] + normal[2] * seen.offset_a[2];
  Real length = Lanes::sqrt(square);
  length = one / Lanes::select(Lanes::less(between, zero), -length, length);
  for (Real& x : normal) x = x * length;

  // The corner of each that is deepest in the other; of two edges, their middles.
  const Real edges = Lanes::select(face_a, zero, Lanes::select(face_b, zero, one));
  for (int k = 0; k < 3; ++k) {
    const Real half = seen.half_a[k] - seen.half_a[k] * edges * edge_a[k];
    on_a[k] = Lanes::select(Lanes::less(normal[k], zero), -half, half);
    on_b[k] = seen.offset_a[k];
  }
  for (int j = 0; j < 3; ++j) {
    const Real along = normal[0] * p[0][j] + normal[1] * p[1][j] + normal[2] * p[2][j];
    const Real free = pick<Scalar>(least.edge_b, j == 0 ? edges : zero, j == 1 ? edges : zero,
                                   j == 2 ? edges : zero);
    const Real half = seen.half_b[j] - seen.half_b[j] * free;
    const Real reach = Lanes::select(Lanes::less(along, zero), half, -half);
    for (int k = 0; k < 3; ++k) on_b[k] += reach * p[k][j];
  }
  // From the middles to where the lines of two edges are closest. What of edge b is across edge a
  // is taken by coordinate, and so keeps its digits where they are almost parallel.
  Real slide_b = zero, slide_a = zero, cosine = zero;
  for (int k = 0; k < 3; ++k) {
    const Real from_a = on_b[k] - on_a[k];
    slide_b -= from_a * Lanes::select(Lanes::less(zero, edge_a[k]), zero, edge_b[k]);
    slide_a += from_a * edge_a[k];
    cosine += edge_a[k] * edge_b[k];
  }
  const auto is_edges = Lanes::less(zero, edges);
  slide_b = Lanes::select(is_edges, slide_b / square, zero);
  slide_a = Lanes::select(is_edges, slide_a + slide_b * cosine, zero);
  for (int k = 0; k < 3; ++k) {
    on_a[k] += slide_a * edge_a[k];
    on_b[k] += slide_b * edge_b[k];
    const Real apart = depth * normal[k];
    const Real moved_a = on_b[k] + apart, moved_b = on_a[k] - apart;
    on_a[k] = Lanes::select(face_a, moved_a, on_a[k]);
    on_b[k] = Lanes::select(face_b, moved_b, on_b[k]);
  }

  unsigned good = on_boxes<Scalar>(seen, contact);
  if ((overlapping & ~good) == 0) return overlapping;
  Contact<Scalar> slid = contact;
  slide_together<Scalar>(seen, slid);
  const auto accepted = Lanes::mask(good);
  for (int k = 0; k < 3; ++k) {
    on_a[k] = Lanes::select(accepted, on_a[k], slid.on_a[k]);
    on_b[k] = Lanes::select(accepted, on_b[k], slid.on_b[k]);
  }
  good |= on_boxes<Scalar>(seen, slid);
  return overlapping & good;
}

template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Vectors<Scalar> to_world(
    const Vectors<Scalar> columns[3], const typename RealLanes<Scalar>::Real v[3]) {
  return {columns[0].x * v[0] + columns[1].x * v[1] + columns[2].x * v[2],
          columns[0].y * v[0] + columns[1].y * v[1] + columns[2].y * v[2],
          columns[0].z * v[0] + columns[1].z * v[1] + columns[2].z * v[2]};
}

// Writes all numbers of the outcomes of those lanes that are known to overlap; the lanes of which
// that was possible.
template <class Scalar>
TOUCHSTONE_TARGET unsigned write_depths(const PairTable<Scalar>& table, std::size_t begin,
                                        const BoxColumns<Scalar>& boxes,
                                        const BoxProducts<Scalar>& seen, unsigned overlapping) {
  using Lanes = RealLanes<Scalar>;
  using Real = typename Lanes::Real;
  Contact<Scalar> contact;
  overlapping = find_contacts<Scalar>(seen, overlapping, contact);
  const Vectors<Scalar> normal = to_world<Scalar>(boxes.a, contact.normal);
  const Vectors<Scalar> on_a = to_world<Scalar>(boxes.a, contact.on_a);
  const Vectors<Scalar> on_b = to_world<Scalar>(boxes.a, contact.on_b);
  // Any axis has a depth that is not less than the least; it takes all of them to know that.
  const Real lower = -contact.depth - GapError<Scalar>::coarse * seen.size;
  const Real upper = GapError<Scalar>::fine * seen.size - contact.depth;
  write_numbers<Scalar>(table, begin, overlapping,
                        {-contact.depth, lower, upper, normal, on_a, on_b});
  return overlapping;
}
