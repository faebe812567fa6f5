// The loops of face_planes.h. face_planes.cpp includes this file once for each level of vector
// instructions, inside that level's namespace. Results are equal at every level.
#include "algorithms/kernels/epa/triangle_lanes.inl"

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

// Gathers a vector of points' differences.
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Vectors<Scalar> differences(
    const DifferencePoint<Scalar>* points, const int* places) {
  using Lanes = RealLanes<Scalar>;
  Quad<Scalar> quads[Lanes::width];
  for (std::size_t k = 0; k < Lanes::width; ++k) {
    // The fourth number is whatever follows in the point; it is not used.
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
  bool all_inside = true;
  const Vectors<Scalar> c = {Lanes::broadcast(cone.tip.x()), Lanes::broadcast(cone.tip.y()),
                             Lanes::broadcast(cone.tip.z())};
  for (std::size_t i = 0; i < cone.size; i += Lanes::width) {
    const Vectors<Scalar> a = differences(cone.points, cone.ring + i);
    const Vectors<Scalar> b = differences(cone.points, cone.ring + i + 1);
    const TrianglePlanes<Scalar> found = triangle_planes<Scalar>(a, b, c);
    const Real distance = found.distance;
    const Real margin = found.squared - Lanes::broadcast(uncertain<Scalar>) * found.length;
    store(planes.x.data() + i, found.normal.x);
    store(planes.y.data() + i, found.normal.y);
    store(planes.z.data() + i, found.normal.z);
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
