// The loops of face_planes.h. Included by face_planes.cpp once for each level of vector
// instructions, inside that level's namespace; the same at every level.

template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE typename RealLanes<Scalar>::Real load(const Scalar* from) {
  typename RealLanes<Scalar>::Real v;
  std::memcpy(&v, from, sizeof v);
  return v;
}

template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void store(Scalar* to, typename RealLanes<Scalar>::Real v) {
  std::memcpy(to, &v, sizeof v);
}

template <class Scalar>
TOUCHSTONE_TARGET int least_key_at(std::span<const Block<Scalar>> blocks) {
  using Lanes = RealLanes<Scalar>;
  using Real = typename Lanes::Real;
  constexpr std::size_t size = Block<Scalar>::size, blocks_a_word = faces_a_word / size;
  const std::size_t count = blocks.size();
  Real best = load(blocks[0].key);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = 0; k < size; k += Lanes::width) {
      best = Lanes::min(best, load(blocks[i].key + k));
    }
  }
  const Real least = Lanes::broadcast(-Lanes::greatest(-best));
  for (std::size_t first = 0; first < count; first += blocks_a_word) {
    std::uint64_t found = 0;
    for (std::size_t i = first; i < std::min(first + blocks_a_word, count); ++i) {
      for (std::size_t k = 0; k < size; k += Lanes::width) {
        const unsigned greater = Lanes::bits(Lanes::less(least, load(blocks[i].key + k)));
        constexpr unsigned all = (1u << Lanes::width) - 1;
        found |= std::uint64_t{~greater & all} << ((i - first) * size + k);
      }
    }
    if (found != 0) return static_cast<int>(first * size) + std::countr_zero(found);
  }
  return 0;
}

template <class Scalar>
TOUCHSTONE_TARGET void seen_from_at(std::span<const Block<Scalar>> blocks,
                                    const Vec3<Scalar>& point, Scalar above, std::uint64_t* seen) {
  using Lanes = RealLanes<Scalar>;
  using Real = typename Lanes::Real;
  constexpr std::size_t size = Block<Scalar>::size, blocks_a_word = faces_a_word / size;
  const std::size_t count = blocks.size();
  const Real px = Lanes::broadcast(point.x());
  const Real py = Lanes::broadcast(point.y());
  const Real pz = Lanes::broadcast(point.z());
  const Real least = Lanes::broadcast(above);
  for (std::size_t first = 0; first < count; first += blocks_a_word) {
    std::uint64_t bits = 0;
    for (std::size_t i = first; i < std::min(first + blocks_a_word, count); ++i) {
      const Block<Scalar>& b = blocks[i];
      for (std::size_t k = 0; k < size; k += Lanes::width) {
        const Real height = load(b.x + k) * px + load(b.y + k) * py + load(b.z + k) * pz;
        const auto mask = Lanes::less(least, height - load(b.distance + k));
        bits |= std::uint64_t{Lanes::bits(mask)} << ((i - first) * size + k);
      }
    }
    seen[first / blocks_a_word] = bits;
  }
}

template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Vectors<Scalar> cross(const Vectors<Scalar>& a,
                                                          const Vectors<Scalar>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Vectors<Scalar> minus(const Vectors<Scalar>& a,
                                                          const Vectors<Scalar>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
// The differences of a vector of points.
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Vectors<Scalar> differences(
    const DifferencePoint<Scalar>* points, const int* places) {
  using Lanes = RealLanes<Scalar>;
  Quad<Scalar> quads[Lanes::width];
  for (std::size_t k = 0; k < Lanes::width; ++k) {
    // With a number of what follows in the point.
    std::memcpy(&quads[k], &points[places[k]], sizeof quads[k]);
  }
  typename Lanes::Real columns[4];
  columns_of<Scalar>(quads, columns);
  return {columns[0], columns[1], columns[2]};
}

template <class Scalar>
TOUCHSTONE_TARGET bool planes_through_at(const Cone<Scalar>& cone, Scalar inside, Scalar furthest,
                                         ConePlanes<Scalar>& planes) {
  using Lanes = RealLanes<Scalar>;
  using Real = typename Lanes::Real;
  constexpr Scalar flat = flat_height<Scalar> * flat_height<Scalar>;
  bool all_inside = true;
  const Vectors<Scalar> c = {Lanes::broadcast(cone.tip.x()), Lanes::broadcast(cone.tip.y()),
                             Lanes::broadcast(cone.tip.z())};
  for (std::size_t i = 0; i < cone.size; i += Lanes::width) {
    const Vectors<Scalar> a = differences(cone.points, cone.ring + i);
    const Vectors<Scalar> b = differences(cone.points, cone.ring + i + 1);
    const Vectors<Scalar> bc = minus<Scalar>(c, b), ca = minus<Scalar>(a, c),
                          ab = minus<Scalar>(b, a);
    const Real opposite_a = dot<Scalar>(bc, bc);
    const Real opposite_b = dot<Scalar>(ca, ca);
    const Real opposite_c = dot<Scalar>(ab, ab);
    const auto b_over_a = Lanes::less(opposite_a, opposite_b);
    const Real of_two = Lanes::select(b_over_a, opposite_b, opposite_a);
    const auto c_over_both = Lanes::less(of_two, opposite_c);
    const auto choose = [&](const Vectors<Scalar>& of_a, const Vectors<Scalar>& of_b,
                            const Vectors<Scalar>& of_c) TOUCHSTONE_TARGET {
      const auto of = [&](Real x, Real y, Real z) TOUCHSTONE_TARGET {
        return Lanes::select(c_over_both, z, Lanes::select(b_over_a, y, x));
      };
      return Vectors<Scalar>{of(of_a.x, of_b.x, of_c.x), of(of_a.y, of_b.y, of_c.y),
                             of(of_a.z, of_b.z, of_c.z)};
    };
    const Real one = Lanes::broadcast(1);
    const Real length = Lanes::select(c_over_both, opposite_c, of_two);
    const Real inverse = one / length;
    const Vectors<Scalar> longest = choose(bc, ca, ab);
    const Vectors<Scalar> base = choose(a, b, c);
    Vectors<Scalar> normal = cross<Scalar>(choose(ca, ab, bc), choose(ab, bc, ca));
    const Real along = dot<Scalar>(normal, longest) * inverse;
    normal = {normal.x - along * longest.x, normal.y - along * longest.y,
              normal.z - along * longest.z};
    const Real squared = dot<Scalar>(normal, normal);
    const Real scale = Lanes::sqrt(squared) * (one / squared);
    const Real distance = Lanes::select(Lanes::less(Lanes::broadcast(flat) * length, squared),
                                        dot<Scalar>(normal, base) * scale,
                                        Lanes::broadcast(std::numeric_limits<Scalar>::quiet_NaN()));
    const Real margin = squared - Lanes::broadcast(uncertain<Scalar>) * length;
    store(planes.x.data() + i, normal.x * scale);
    store(planes.y.data() + i, normal.y * scale);
    store(planes.z.data() + i, normal.z * scale);
    store(planes.distance.data() + i, distance);
    store(planes.margin.data() + i, margin);
    const auto needless = Lanes::less(Lanes::broadcast(furthest), distance);
    constexpr Scalar infinity = std::numeric_limits<Scalar>::infinity();
    store(planes.key.data() + i, Lanes::select(needless, Lanes::broadcast(infinity), distance));
    const unsigned good = Lanes::bits(Lanes::less(Lanes::broadcast(inside), distance));
    const unsigned used = (1u << std::min(Lanes::width, cone.size - i)) - 1;
    all_inside = all_inside && (~good & used) == 0;
  }
  return all_inside;
}
