// The loops of face_planes.h. face_planes.cpp includes this file once for each level of vector
// instructions, inside that level's namespace. Results are equal at every level.
#include "algorithms/kernels/epa/triangle_lanes.inl"

template <class Scalar>
TOUCHSTONE_TARGET int least_key_at(std::span<const Block<Scalar>> blocks) {
  using Lanes = Simd<Scalar>;
  using Vector = typename Lanes::Vector;
  constexpr std::size_t size = Block<Scalar>::size, blocks_a_word = faces_a_word / size;
  const std::size_t count = blocks.size();
  Vector best = Lanes::load(blocks[0].key);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = 0; k < size; k += Lanes::width) {
      best = Lanes::min(best, Lanes::load(blocks[i].key + k));
    }
  }
  const Vector least = Lanes::broadcast(-Lanes::reduce_max(-best));
  for (std::size_t first = 0; first < count; first += blocks_a_word) {
    std::uint64_t found = 0;
    for (std::size_t i = first; i < std::min(first + blocks_a_word, count); ++i) {
      for (std::size_t k = 0; k < size; k += Lanes::width) {
        const unsigned greater = Lanes::to_bits(Lanes::less(least, Lanes::load(blocks[i].key + k)));
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
  using Lanes = Simd<Scalar>;
  using Vector = typename Lanes::Vector;
  constexpr std::size_t size = Block<Scalar>::size, blocks_a_word = faces_a_word / size;
  const std::size_t count = blocks.size();
  const Vector px = Lanes::broadcast(point.x());
  const Vector py = Lanes::broadcast(point.y());
  const Vector pz = Lanes::broadcast(point.z());
  const Vector least = Lanes::broadcast(above);
  for (std::size_t first = 0; first < count; first += blocks_a_word) {
    std::uint64_t bits = 0;
    for (std::size_t i = first; i < std::min(first + blocks_a_word, count); ++i) {
      const Block<Scalar>& b = blocks[i];
      for (std::size_t k = 0; k < size; k += Lanes::width) {
        const Vector height =
            Lanes::load(b.x + k) * px + Lanes::load(b.y + k) * py + Lanes::load(b.z + k) * pz;
        const auto mask = Lanes::less(least, height - Lanes::load(b.distance + k));
        bits |= std::uint64_t{Lanes::to_bits(mask)} << ((i - first) * size + k);
      }
    }
    seen[first / blocks_a_word] = bits;
  }
}

// Gathers a vector of points' differences.
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Vector3<Scalar> differences(
    const DifferencePoint<Scalar>* points, const int* places) {
  using Lanes = Simd<Scalar>;
  Quad<Scalar> quads[Lanes::width];
  for (std::size_t k = 0; k < Lanes::width; ++k) {
    // The fourth number is whatever follows in the point; it is not used.
    std::memcpy(&quads[k], &points[places[k]], sizeof quads[k]);
  }
  typename Lanes::Vector columns[4];
  columns_of<Scalar>(quads, columns);
  return {columns[0], columns[1], columns[2]};
}

template <class Scalar>
TOUCHSTONE_TARGET bool planes_through_at(const Cone<Scalar>& cone, Scalar inside, Scalar furthest,
                                         ConePlanes<Scalar>& planes) {
  using Lanes = Simd<Scalar>;
  using Vector = typename Lanes::Vector;
  bool all_inside = true;
  const Vector3<Scalar> c = {Lanes::broadcast(cone.tip.x()), Lanes::broadcast(cone.tip.y()),
                             Lanes::broadcast(cone.tip.z())};
  for (std::size_t i = 0; i < cone.size; i += Lanes::width) {
    const Vector3<Scalar> a = differences(cone.points, cone.ring + i);
    const Vector3<Scalar> b = differences(cone.points, cone.ring + i + 1);
    const TrianglePlanes<Scalar> found = triangle_planes<Scalar>(a, b, c);
    const Vector distance = found.distance;
    const Vector margin = found.squared - Lanes::broadcast(uncertain<Scalar>) * found.length;
    Lanes::store(planes.x.data() + i, found.normal.x);
    Lanes::store(planes.y.data() + i, found.normal.y);
    Lanes::store(planes.z.data() + i, found.normal.z);
    Lanes::store(planes.distance.data() + i, distance);
    Lanes::store(planes.margin.data() + i, margin);
    const auto needless = Lanes::less(Lanes::broadcast(furthest), distance);
    constexpr Scalar infinity = std::numeric_limits<Scalar>::infinity();
    Lanes::store(planes.key.data() + i,
                 Lanes::select(needless, Lanes::broadcast(infinity), distance));
    const unsigned good = Lanes::to_bits(Lanes::less(Lanes::broadcast(inside), distance));
    const unsigned used = (1u << std::min(Lanes::width, cone.size - i)) - 1;
    all_inside = all_inside && (~good & used) == 0;
  }
  return all_inside;
}
