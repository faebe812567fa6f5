// Part of gjk-lanes, included by lane_depths.inl: the support points of lanes.

// The vertex that is furthest along `search`, or least far; the first of several. `count` is a
// multiple of four.
template <class Scalar, bool forward>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Vector3<Scalar> furthest_vertex(const Vector3<Scalar>* vertices,
                                                                    std::uint32_t count,
                                                                    const Vector3<Scalar>& search) {
  using Lanes = Simd<Scalar>;
  using Vector = typename Lanes::Vector;
  Vector3<Scalar> best = vertices[0];
  Vector reach = dot<Scalar>(best, search);
  for (const Vector3<Scalar>* const end = vertices + count; vertices != end; vertices += 4) {
    for (int k = 0; k < 4; ++k) {
      const Vector own = dot<Scalar>(vertices[k], search);
      const auto better = forward ? Lanes::less(reach, own) : Lanes::less(own, reach);
      reach = forward ? Lanes::max(own, reach) : Lanes::min(own, reach);
      best = select<Scalar>(better, vertices[k], best);
    }
  }
  return best;
}

// Adds or subtracts each half edge, so that the corner is furthest along `search`, or least far.
template <class Scalar, bool forward>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Vector3<Scalar> furthest_corner(const Vector3<Scalar>* halves,
                                                                    int count,
                                                                    const Vector3<Scalar>& centre,
                                                                    const Vector3<Scalar>& search) {
  using Lanes = Simd<Scalar>;
  const auto one = Lanes::broadcast(forward ? 1 : -1), zero = Lanes::broadcast(0);
  Vector3<Scalar> corner = centre;
  for (int k = 0; k < count; ++k) {
    const auto backward = Lanes::less(dot<Scalar>(halves[k], search), zero);
    corner = moved<Scalar>(corner, Lanes::select(backward, -one, one), halves[k]);
  }
  return corner;
}

// The vertex of each lane that is furthest in its direction, rotated by the matrix of these
// columns.
template <class Scalar>
TOUCHSTONE_TARGET Vector3<Scalar> scanned_vertex(const hull_scan::ScannedHull<Scalar>* hulls,
                                                 const Vector3<Scalar> columns[3],
                                                 const Vector3<Scalar>& direction,
                                                 unsigned active) {
  using Vector = typename Simd<Scalar>::Vector;
  constexpr std::size_t width = Simd<Scalar>::width;
  constexpr std::uint32_t size = hull_scan::VertexBlock<Scalar>::size;
  const Vector turned[3] = {dot<Scalar>(columns[0], direction), dot<Scalar>(columns[1], direction),
                            dot<Scalar>(columns[2], direction)};
  alignas(64) Scalar x[width]{}, y[width]{}, z[width]{};
  alignas(64) Scalar towards[3][width];
  std::memcpy(towards, turned, sizeof towards);
  for (; active != 0; active &= active - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(active));
    const std::uint32_t best =
        furthest_index(hulls[lane], towards[0][lane], towards[1][lane], towards[2][lane]);
    const hull_scan::VertexBlock<Scalar>& block = hulls[lane].blocks[best / size];
    x[lane] = block.x[best % size];
    y[lane] = block.y[best % size];
    z[lane] = block.z[best % size];
  }
  Vector of[3];
  std::memcpy(&of[0], x, sizeof x);
  std::memcpy(&of[1], y, sizeof y);
  std::memcpy(&of[2], z, sizeof z);
  return moved<Scalar>(moved<Scalar>(scaled<Scalar>(of[0], columns[0]), of[1], columns[1]), of[2],
                       columns[2]);
}

// The point of a round core that is furthest along `search`, or least far. `axes` are the columns of
// the matrix times the core's extents, so the core is an image of the unit ball, cylinder or cone.
// Squares of a reach that have lost digits belong to reaches below a rounding of the unit: the
// centre is as good a point there.
template <class Scalar, bool forward>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Vector3<Scalar> furthest_round_point(
    const Vector3<Scalar>* axes, RoundCore core, const Vector3<Scalar>& centre,
    const Vector3<Scalar>& search, typename Simd<Scalar>::Vector length) {
  using Lanes = Simd<Scalar>;
  using Vector = typename Lanes::Vector;
  const Vector zero = Lanes::broadcast(0), one = Lanes::broadcast(forward ? 1 : -1);
  const Vector3<Scalar> direction = scaled<Scalar>(one / length, search);
  const Vector x = dot<Scalar>(axes[0], direction), y = dot<Scalar>(axes[1], direction),
               z = dot<Scalar>(axes[2], direction);
  const bool is_ball = core == RoundCore::ellipsoid;
  const Vector flat = x * x + y * y, square = is_ball ? flat + z * z : flat;
  const Vector reach = Lanes::sqrt(square);
  const auto some = Lanes::less(Lanes::broadcast(shortest_reach_square<Scalar>), square);
  Vector rim = Lanes::select(some, Lanes::broadcast(1) / reach, zero), along = z * rim;
  if (!is_ball) {
    const Vector top = Lanes::broadcast(1);
    if (core == RoundCore::cylinder) {
      along = Lanes::select(Lanes::less(z, zero), -top, top);
    } else {
      const auto tip = Lanes::less(reach, z + z);
      along = Lanes::select(tip, top, -top);
      rim = Lanes::select(tip, zero, rim);
    }
  }
  return moved<Scalar>(moved<Scalar>(moved<Scalar>(centre, x * rim, axes[0]), y * rim, axes[1]),
                       along, axes[2]);
}

// The point on the core of a that is least far along `search`, the point on b that is furthest, and
// their difference. `length` is that of `search`.
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Corner<Scalar> find_corner(const LaneGoal<Scalar>& goal,
                                                               const LaneState<Scalar>& state,
                                                               const Vector3<Scalar>& search,
                                                               typename Simd<Scalar>::Vector length,
                                                               unsigned active) {
  using Lanes = Simd<Scalar>;
  using Vector = typename Lanes::Vector;
  const Vector zero = Lanes::broadcast(0);
  Corner<Scalar> corner;
  Vector3<Scalar> on_b;
  if (goal.scans_a) {
    corner.on_a =
        scanned_vertex<Scalar>(state.hulls_a, state.a, {-search.x, -search.y, -search.z}, active);
  } else if (goal.vertices_a != 0) {
    corner.on_a = furthest_vertex<Scalar, false>(state.a, goal.vertices_a, search);
  } else if (goal.round_a != RoundCore::none) {
    corner.on_a = furthest_round_point<Scalar, false>(state.a, goal.round_a, {zero, zero, zero},
                                                      search, length);
  } else {
    corner.on_a =
        furthest_corner<Scalar, false>(state.a, goal.halves_a, {zero, zero, zero}, search);
  }
  if (goal.scans_b) {
    on_b = scanned_vertex<Scalar>(state.hulls_b, state.b, search, active);
    on_b = moved<Scalar>(on_b, Lanes::broadcast(1), state.centre_b);
  } else if (goal.vertices_b != 0) {
    on_b = furthest_vertex<Scalar, true>(state.b, goal.vertices_b, search);
  } else if (goal.round_b != RoundCore::none) {
    on_b =
        furthest_round_point<Scalar, true>(state.b, goal.round_b, state.centre_b, search, length);
  } else {
    on_b = furthest_corner<Scalar, true>(state.b, goal.halves_b, state.centre_b, search);
  }
  corner.point = difference<Scalar>(corner.on_a, on_b);
  return corner;
}
