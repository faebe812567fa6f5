// Part of gjk-lanes, included by lane_depths.inl: the polytopes that EPA grows in lanes. The
// nearest faces, the faces that a new point sees and the planes of the cone are computed for all
// lanes together; each lane finds its horizon alone.

// The polytopes of one pair per lane. Faces that are removed or not yet made are infinitely far
// away.
template <class Scalar>
struct Expanders {
  using Vector = typename Simd<Scalar>::Vector;
  static constexpr std::size_t width = Simd<Scalar>::width;

  Vector3<Scalar> normal[BitsetHull::most_faces];  // unit, outward
  Vector distance[BitsetHull::most_faces];         // from the origin
  std::size_t faces = 0;                           // the greatest number of faces over all lanes
  // Vertices of the difference, and their points on the core of a.
  Quad<Scalar> points[BitsetHull::most_vertices][width], on_a[BitsetHull::most_vertices][width];
  BitsetHull surfaces[width];
  std::int32_t iterations[width];
  unsigned active = 0;  // lanes, as bits
};

template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Vector3<Scalar> from_quads(const Quad<Scalar>* quads) {
  typename Simd<Scalar>::Vector columns[4];
  columns_of<Scalar>(quads, columns);
  return {columns[0], columns[1], columns[2]};
}
// The quad of lane l is at place(l).
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void to_quads(const Vector3<Scalar>& v, Quad<Scalar>* quads) {
  typename Simd<Scalar>::Vector columns[4] = {v.x, v.y, v.z, v.z};
  quads_of<Scalar>(columns, quads);
}

// The nearest face of each lane.
template <class Scalar>
struct NearestFaces {
  using Vector = typename Simd<Scalar>::Vector;
  Vector3<Scalar> normal;
  Vector distance;
  Vector place;  // the face's index
};

template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE NearestFaces<Scalar> nearest_faces(
    const Expanders<Scalar>& expanders) {
  using Lanes = Simd<Scalar>;
  using Vector = typename Lanes::Vector;
  const Vector one = Lanes::broadcast(1);
  NearestFaces<Scalar> nearest{expanders.normal[0], expanders.distance[0], Lanes::broadcast(0)};
  Vector number = one;
  for (std::size_t face = 1; face < expanders.faces; ++face) {
    const Vector distance = expanders.distance[face];
    const auto nearer = Lanes::less(distance, nearest.distance);
    nearest.distance = Lanes::min(distance, nearest.distance);
    nearest.normal = select<Scalar>(nearer, expanders.normal[face], nearest.normal);
    nearest.place = Lanes::select(nearer, number, nearest.place);
    number = number + one;
  }
  return nearest;
}

// Sets the bits of the faces that the point of their lane sees.
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void find_visible(const Expanders<Scalar>& expanders,
                                                      const Vector3<Scalar>& point, unsigned lanes,
                                                      BitsetHull::Faces seen[Simd<Scalar>::width]) {
  using Lanes = Simd<Scalar>;
  using Vector = typename Lanes::Vector;
  const Vector above = Lanes::broadcast(lane_rounding<Scalar> / 4);
  std::fill_n(seen, Lanes::width, BitsetHull::Faces{});
  for (std::size_t face = 0; face < expanders.faces; ++face) {
    const Vector height = dot<Scalar>(expanders.normal[face], point) - expanders.distance[face];
    const std::uint64_t bit = std::uint64_t{1} << face % 64;
    for (unsigned see = Lanes::to_bits(Lanes::less(above, height)) & lanes; see != 0;
         see &= see - 1) {
      seen[std::countr_zero(see)][face / 64] |= bit;
    }
  }
}

// Replaces the faces that the new vertices see by the cones over their horizons. Returns the lanes
// in which this made a valid polytope, as bits.
template <class Scalar>
TOUCHSTONE_TARGET unsigned add_vertices(Expanders<Scalar>& expanders, const Corner<Scalar>& corner,
                                        unsigned lanes) {
  using Lanes = Simd<Scalar>;
  using Vector = typename Lanes::Vector;
  constexpr std::size_t width = Lanes::width;
  BitsetHull::Faces seen[width];
  find_visible<Scalar>(expanders, corner.point, lanes, seen);
  alignas(64) Quad<Scalar> points[width], on_a[width];
  to_quads<Scalar>(corner.point, points);
  to_quads<Scalar>(corner.on_a, on_a);
  // larger[n]: the lanes whose cone has more than n faces, as bits.
  unsigned larger[BitsetHull::most_vertices + 1]{};
  std::size_t most = 0;
  unsigned good = 0;
  for (unsigned open = lanes; open != 0; open &= open - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(open));
    BitsetHull& surface = expanders.surfaces[lane];
    const std::size_t vertex = surface.vertices();
    expanders.points[vertex][lane] = points[place<Lanes>(lane)];
    expanders.on_a[vertex][lane] = on_a[place<Lanes>(lane)];
    if (!surface.add(seen[lane])) continue;
    good |= 1u << lane;
    const BitsetHull::Cone& cone = surface.cone();
    for (std::size_t i = cone.size; i < cone.size + cone.gone; ++i) {
      reinterpret_cast<Scalar*>(&expanders.distance[cone.places[i]])[lane] =
          std::numeric_limits<Scalar>::infinity();
    }
    // Faces that no lane used before are infinitely far away in the other lanes.
    for (; expanders.faces < surface.faces(); ++expanders.faces) {
      expanders.distance[expanders.faces] =
          Lanes::broadcast(std::numeric_limits<Scalar>::infinity());
    }
    larger[cone.size - 1] |= 1u << lane;
    most = std::max(most, cone.size);
  }
  for (std::size_t i = most; i > 0; --i) larger[i - 1] |= larger[i];

  const auto ring = [&](std::size_t i) TOUCHSTONE_TARGET {
    Quad<Scalar> quads[width];
    for (std::size_t lane = 0; lane < width; ++lane) {
      quads[lane] = expanders.points[expanders.surfaces[lane].cone().ring[i]][lane];
    }
    return from_quads<Scalar>(quads);
  };
  const Vector outside = Lanes::broadcast(-2 * lane_rounding<Scalar>);
  Vector3<Scalar> tail = ring(0);
  for (std::size_t i = 0; i < most; ++i) {
    const Vector3<Scalar> head = ring(i + 1);
    const TrianglePlanes<Scalar> plane = triangle_planes<Scalar>(tail, head, corner.point);
    good &= ~larger[i] | Lanes::to_bits(Lanes::less(outside, plane.distance));
    Vector columns[4] = {plane.normal.x, plane.normal.y, plane.normal.z, plane.distance};
    alignas(64) Scalar numbers[4][width];
    std::memcpy(numbers, columns, sizeof numbers);
    for (unsigned open = larger[i]; open != 0; open &= open - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(open));
      const std::size_t face = expanders.surfaces[lane].cone().places[i];
      auto* const normal = reinterpret_cast<Scalar*>(&expanders.normal[face]) + lane;
      for (std::size_t k = 0; k < 3; ++k) normal[k * width] = numbers[k][lane];
      reinterpret_cast<Scalar*>(&expanders.distance[face])[lane] = numbers[3][lane];
    }
    tail = head;
  }
  return good;
}
