// Part of gjk-lanes, included by lane_depths.inl: the support points of lanes.

// The vertex that is furthest along `way`, or least far; the first of several. `count` is a
// multiple of four.
template <class Scalar, bool forward>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Vectors<Scalar> furthest_vertex(const Vectors<Scalar>* vertices,
                                                                    std::uint32_t count,
                                                                    const Vectors<Scalar>& way) {
  using Lanes = RealLanes<Scalar>;
  using Real = typename Lanes::Real;
  Vectors<Scalar> best = vertices[0];
  Real reach = dot<Scalar>(best, way);
  for (const Vectors<Scalar>* const end = vertices + count; vertices != end; vertices += 4) {
    for (int k = 0; k < 4; ++k) {
      const Real own = dot<Scalar>(vertices[k], way);
      const auto better = forward ? Lanes::less(reach, own) : Lanes::less(own, reach);
      reach = forward ? Lanes::max(own, reach) : Lanes::min(own, reach);
      best = select<Scalar>(better, vertices[k], best);
    }
  }
  return best;
}

// Adds or subtracts each half edge, so that the corner is furthest along `way`, or least far.
template <class Scalar, bool forward>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Vectors<Scalar> furthest_corner(const Vectors<Scalar>* halves,
                                                                    int count,
                                                                    const Vectors<Scalar>& centre,
                                                                    const Vectors<Scalar>& way) {
  using Lanes = RealLanes<Scalar>;
  const auto one = Lanes::broadcast(forward ? 1 : -1), zero = Lanes::broadcast(0);
  Vectors<Scalar> corner = centre;
  for (int k = 0; k < count; ++k) {
    const auto backward = Lanes::less(dot<Scalar>(halves[k], way), zero);
    corner = moved<Scalar>(corner, Lanes::select(backward, -one, one), halves[k]);
  }
  return corner;
}

// The vertex of each lane that is furthest in its direction, rotated by the matrix of these
// columns.
template <class Scalar>
TOUCHSTONE_TARGET Vectors<Scalar> scanned_vertex(
    const hull_scan::VertexBlock<Scalar>* const* blocks, const std::uint32_t* block_counts,
    const Vectors<Scalar> columns[3], const Vectors<Scalar>& direction, unsigned active) {
  using Real = typename RealLanes<Scalar>::Real;
  constexpr std::size_t width = RealLanes<Scalar>::width;
  constexpr std::uint32_t size = hull_scan::VertexBlock<Scalar>::size;
  const Real turned[3] = {dot<Scalar>(columns[0], direction), dot<Scalar>(columns[1], direction),
                          dot<Scalar>(columns[2], direction)};
  alignas(64) Scalar x[width]{}, y[width]{}, z[width]{};
  alignas(64) Scalar towards[3][width];
  std::memcpy(towards, turned, sizeof towards);
  for (; active != 0; active &= active - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(active));
    const std::span<const hull_scan::VertexBlock<Scalar>> all(blocks[lane], block_counts[lane]);
    const std::uint32_t best =
        furthest_at(all, towards[0][lane], towards[1][lane], towards[2][lane]).index;
    const hull_scan::VertexBlock<Scalar>& block = blocks[lane][best / size];
    x[lane] = block.x[best % size];
    y[lane] = block.y[best % size];
    z[lane] = block.z[best % size];
  }
  Real of[3];
  std::memcpy(&of[0], x, sizeof x);
  std::memcpy(&of[1], y, sizeof y);
  std::memcpy(&of[2], z, sizeof z);
  return moved<Scalar>(moved<Scalar>(scaled<Scalar>(of[0], columns[0]), of[1], columns[1]), of[2],
                       columns[2]);
}

// The point on the core of a that is least far along `way`, the point on b that is furthest, and
// their difference.
template <class Scalar, bool scans>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Corner<Scalar> find_corner(const LaneGoal<Scalar>& goal,
                                                               const Walkers<Scalar>& walkers,
                                                               const Vectors<Scalar>& way,
                                                               unsigned active) {
  using Lanes = RealLanes<Scalar>;
  using Real = typename Lanes::Real;
  const Real zero = Lanes::broadcast(0);
  Corner<Scalar> corner;
  Vectors<Scalar> on_b;
  if (scans && goal.scans_a) {
    corner.on_a = scanned_vertex<Scalar>(walkers.corners_a, walkers.blocks_a, walkers.a,
                                         {-way.x, -way.y, -way.z}, active);
  } else if (goal.vertices_a != 0) {
    corner.on_a = furthest_vertex<Scalar, false>(walkers.a, goal.vertices_a, way);
  } else {
    corner.on_a = furthest_corner<Scalar, false>(walkers.a, goal.halves_a, {zero, zero, zero}, way);
  }
  if (scans && goal.scans_b) {
    on_b = scanned_vertex<Scalar>(walkers.corners_b, walkers.blocks_b, walkers.b, way, active);
    on_b = moved<Scalar>(on_b, Lanes::broadcast(1), walkers.centre_b);
  } else if (goal.vertices_b != 0) {
    on_b = furthest_vertex<Scalar, true>(walkers.b, goal.vertices_b, way);
  } else {
    on_b = furthest_corner<Scalar, true>(walkers.b, goal.halves_b, walkers.centre_b, way);
  }
  corner.point = difference<Scalar>(corner.on_a, on_b);
  return corner;
}
