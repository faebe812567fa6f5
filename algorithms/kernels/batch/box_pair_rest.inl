// Pairs of boxes whose faces meet within rounding, for box_pair_lanes.h. box_pair_lanes.inl includes
// this file.
//
// The plane of a face bounds the signed distance from below. A point of either box bounds it from
// above: by the distance of the two, minus how far the first is inside its box. Both bounds hold for
// the matrices as they are, and need no axis of two edges.

// Lanes whose answer is known, and of these the ones whose numbers are.
template <class Scalar>
struct FaceMeeting {
  unsigned apart, touching, overlapping, measured;
  Numbers<Scalar> numbers;
};

// The coordinates of a vector along the edges of a box, each within bounds.
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void clamp_along(const Vector3<Scalar> edges[3],
                                                     const Vector3<Scalar>& v,
                                                     const typename Simd<Scalar>::Vector low[3],
                                                     const typename Simd<Scalar>::Vector high[3],
                                                     typename Simd<Scalar>::Vector at[3]) {
  using Lanes = Simd<Scalar>;
  for (int k = 0; k < 3; ++k) {
    at[k] = Lanes::min(Lanes::max(dot<Scalar>(edges[k], v), low[k]), high[k]);
  }
}
// Judges the lanes by the face with the greatest gap. The other box meets it with a corner, an edge
// or a face; which of its points are over the face is found by projecting on either in turn.
template <class Scalar>
TOUCHSTONE_TARGET FaceMeeting<Scalar> meet_at_face(const BoxColumns<Scalar>& boxes,
                                                   const BoxProducts<Scalar>& seen, unsigned open) {
  using Lanes = Simd<Scalar>;
  using Vector = typename Lanes::Vector;
  constexpr int most_rounds = 8;
  const Vector zero = Lanes::broadcast(0), one = Lanes::broadcast(1);

  // The box with the face comes first.
  Vector greatest = seen.face_gaps[0], number = zero;
  for (int k = 1; k < 6; ++k) {
    const auto better = Lanes::less(greatest, seen.face_gaps[k]);
    greatest = Lanes::max(seen.face_gaps[k], greatest);
    number = Lanes::select(better, Lanes::broadcast(static_cast<Scalar>(k)), number);
  }
  const auto of_b = Lanes::less(Lanes::broadcast(Scalar(2.5)), number);
  number = number - Lanes::select(of_b, Lanes::broadcast(3), zero);
  Vector3<Scalar> own[3], other[3];
  Vector half_own[3], half_other[3];
  for (int k = 0; k < 3; ++k) {
    own[k] = select<Scalar>(of_b, boxes.b[k], boxes.a[k]);
    other[k] = select<Scalar>(of_b, boxes.a[k], boxes.b[k]);
    half_own[k] = Lanes::select(of_b, seen.half_b[k], seen.half_a[k]);
    half_other[k] = Lanes::select(of_b, seen.half_a[k], seen.half_b[k]);
  }
  const Vector3<Scalar> offset =
      scaled<Scalar>(Lanes::select(of_b, -one, one), boxes.offset);  // to the centre of the other
  const Vector3<Scalar> column = {pick<Scalar>(number, own[0].x, own[1].x, own[2].x),
                                  pick<Scalar>(number, own[0].y, own[1].y, own[2].y),
                                  pick<Scalar>(number, own[0].z, own[1].z, own[2].z)};
  const Vector along = dot<Scalar>(column, offset);
  const Vector side = Lanes::select(Lanes::less(along, zero), -one, one);
  const Vector3<Scalar> normal = scaled<Scalar>(side, column);

  // The gap, by the extents along the normal as it is; and the feature of the other box, whose
  // coordinates are free where they hardly change the height.
  const Vector room = GapError<Scalar>::room * seen.size;
  const Vector error = GapError<Scalar>::rest * seen.size;
  Vector reach_own = zero, reach_other = zero, low_other[3], high_other[3];
  for (int k = 0; k < 3; ++k) {
    reach_own = reach_own + half_own[k] * Lanes::abs(dot<Scalar>(normal, own[k]));
    const Vector reach = half_other[k] * dot<Scalar>(normal, other[k]);
    reach_other = reach_other + Lanes::abs(reach);
    low_other[k] = Lanes::select(Lanes::less(reach, -room), half_other[k], -half_other[k]);
    high_other[k] = Lanes::select(Lanes::less(room, reach), -half_other[k], half_other[k]);
  }
  const Vector gap = (Lanes::abs(along) - reach_own) - reach_other;
  const Vector depth = Lanes::max(-gap, zero), apart = Lanes::max(gap, zero);

  // The first point is that deep inside its box, from every face.
  Vector low_own[3], high_own[3];
  for (int k = 0; k < 3; ++k) {
    const Vector inside = Lanes::max(half_own[k] - depth, zero);
    const auto at_face = [&](Vector lateral) TOUCHSTONE_TARGET {
      return pick<Scalar>(number, k == 0 ? side : lateral, k == 1 ? side : lateral,
                          k == 2 ? side : lateral);
    };
    low_own[k] = inside * at_face(-one);
    high_own[k] = inside * at_face(one);
  }
  const Vector3<Scalar> up = scaled<Scalar>(apart, normal);
  const Vector3<Scalar> start = difference<Scalar>(up, offset);
  Vector at_own[3], at_other[3];
  Vector3<Scalar> point, between;  // of the other box; from the first box's point to it
  clamp_along<Scalar>(own, offset, low_own, high_own, at_own);
  for (int k = 0; k < 3; ++k) at_other[k] = zero;
  // A lane ends where its points are next to each other, whatever the other lanes need.
  unsigned ended = 0;
  for (int round = 0; round < most_rounds; ++round) {
    const auto stays = Lanes::from_bits(ended);
    const auto keep = [&](const Vector now[3], Vector place[3]) TOUCHSTONE_TARGET {
      for (int k = 0; k < 3; ++k) place[k] = Lanes::select(stays, place[k], now[k]);
    };
    Vector now[3];
    clamp_along<Scalar>(other, sum<Scalar>(to_world<Scalar>(own, at_own), start), low_other,
                        high_other, now);
    keep(now, at_other);
    point = sum<Scalar>(offset, to_world<Scalar>(other, at_other));
    clamp_along<Scalar>(own, difference<Scalar>(point, up), low_own, high_own, now);
    keep(now, at_own);
    between = difference<Scalar>(point, to_world<Scalar>(own, at_own));
    const Vector3<Scalar> miss = difference<Scalar>(between, up);
    const Vector most = Lanes::max(Lanes::max_abs(miss.x, miss.y), Lanes::abs(miss.z));
    ended |= ~Lanes::to_bits(Lanes::less(room, most));
    if ((open & ~ended) == 0) break;
  }

  Vector inside = half_own[0] - Lanes::abs(at_own[0]);
  for (int k = 1; k < 3; ++k) inside = Lanes::min(half_own[k] - Lanes::abs(at_own[k]), inside);
  const Vector apart_at_most = Lanes::sqrt(dot<Scalar>(between, between)) - inside;
  const Vector lower = gap - error, upper = apart_at_most + error;

  FaceMeeting<Scalar> found;
  found.apart = open & Lanes::to_bits(Lanes::less(zero, lower));
  found.measured =
      open & Lanes::to_bits(Lanes::less(upper - lower, GapError<Scalar>::widest * seen.size));
  found.overlapping = found.measured & Lanes::to_bits(Lanes::less(upper, zero));
  // Farther from contact another proof may decide.
  const Vector farthest = Lanes::max(Lanes::abs(gap), apart_at_most);
  found.touching = found.measured & ~found.apart & ~found.overlapping &
                   Lanes::to_bits(Lanes::less(farthest, GapError<Scalar>::at_contact * seen.size));
  const Vector3<Scalar> opposite = difference<Scalar>(point, scaled<Scalar>(gap, normal));
  const Vector3<Scalar> on_a = select<Scalar>(of_b, point, opposite);
  const Vector3<Scalar> on_b = select<Scalar>(of_b, opposite, point);
  // The points are seen from the centre of the box with the face.
  const Vector3<Scalar> centre = scaled<Scalar>(Lanes::select(of_b, one, zero), boxes.offset);
  found.numbers = {gap,
                   lower,
                   upper,
                   scaled<Scalar>(Lanes::select(of_b, -one, one), normal),
                   sum<Scalar>(centre, on_a),
                   sum<Scalar>(centre, on_b)};
  return found;
}

// Writes the bounds of these lanes, and no other number.
template <class Scalar>
TOUCHSTONE_TARGET void write_bounds(const PairTable<Scalar>& table, std::size_t begin,
                                    unsigned lanes, const Numbers<Scalar>& numbers) {
  using Lanes = Simd<Scalar>;
  alignas(64) Scalar lower[Lanes::width], upper[Lanes::width];
  Lanes::store(lower, numbers.lower);
  Lanes::store(upper, numbers.upper);
  const std::size_t count = table.pairs.first.size() - begin;
  if (count < Lanes::width) lanes &= (1u << count) - 1;
  for (; lanes != 0; lanes &= lanes - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(lanes));
    table.outcomes[begin + lane].lower = static_cast<double>(lower[lane]);
    table.outcomes[begin + lane].upper = static_cast<double>(upper[lane]);
  }
}

// Turns the answers of these lanes, which share points, into `touching`.
template <class Scalar>
TOUCHSTONE_TARGET void write_touching(const PairTable<Scalar>& table, std::size_t begin,
                                      unsigned lanes) {
  const std::size_t count = table.pairs.first.size() - begin;
  if (count < Simd<Scalar>::width) lanes &= (1u << count) - 1;
  for (; lanes != 0; lanes &= lanes - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(lanes));
    table.outcomes[begin + lane].answer = Answer::touching;
  }
}
