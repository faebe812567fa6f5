// The loops of polytope_surface.h. Included by polytope_surface.cpp once for each level of vector
// instructions, inside that level's namespace; the same at every level.

template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE typename RealLanes<Scalar>::Real load(const Scalar* from) {
  typename RealLanes<Scalar>::Real v;
  std::memcpy(&v, from, sizeof v);
  return v;
}

// The first of the faces with the least key.
template <class Scalar>
TOUCHSTONE_TARGET int least_key(const Block<Scalar>* blocks, std::size_t count) {
  using Lanes = RealLanes<Scalar>;
  using Real = typename Lanes::Real;
  constexpr std::size_t size = PolytopeSurface<Scalar>::block_size;
  Real best = load(blocks[0].key);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = 0; k < size; k += Lanes::width) {
      best = Lanes::min(best, load(blocks[i].key + k));
    }
  }
  const Real least = Lanes::broadcast(-Lanes::greatest(-best));
  for (std::size_t i = 0; i < count; ++i) {
    unsigned greater = 0;
    for (std::size_t k = 0; k < size; k += Lanes::width) {
      greater |= Lanes::bits(Lanes::less(least, load(blocks[i].key + k))) << k;
    }
    const unsigned found = ~greater & ((1u << size) - 1);
    if (found != 0) return static_cast<int>(i * size) + std::countr_zero(found);
  }
  return 0;
}

// Bits of the faces in each block whose plane is further than `above` below the point.
template <class Scalar>
TOUCHSTONE_TARGET void seen_from(const Block<Scalar>* blocks, std::size_t count,
                                 const Vec3<Scalar>& point, Scalar above, std::uint32_t* seen) {
  using Lanes = RealLanes<Scalar>;
  using Real = typename Lanes::Real;
  const Real px = Lanes::broadcast(point.x());
  const Real py = Lanes::broadcast(point.y());
  const Real pz = Lanes::broadcast(point.z());
  const Real least = Lanes::broadcast(above);
  for (std::size_t i = 0; i < count; ++i) {
    const Block<Scalar>& b = blocks[i];
    unsigned bits = 0;
    for (std::size_t k = 0; k < PolytopeSurface<Scalar>::block_size; k += Lanes::width) {
      const Real height = load(b.x + k) * px + load(b.y + k) * py + load(b.z + k) * pz;
      bits |= Lanes::bits(Lanes::less(least, height - load(b.distance + k))) << k;
    }
    seen[i] = bits;
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
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Vectors<Scalar> vectors_at(const Columns<Scalar>& columns,
                                                               std::size_t i) {
  return {load(columns.x.data() + i), load(columns.y.data() + i), load(columns.z.data() + i)};
}

// triangle_plane of simplex.h for all triangles a, b, c, with unit normals. The distance of a flat
// one is NaN.
template <class Scalar>
TOUCHSTONE_TARGET void planes_through(const Triangles<Scalar>& triangles, std::size_t count,
                                      Columns<Scalar>& normals, Scalar* distances) {
  using Lanes = RealLanes<Scalar>;
  using Real = typename Lanes::Real;
  constexpr Scalar flat = flat_height<Scalar> * flat_height<Scalar>;
  for (std::size_t i = 0; i < count; i += Lanes::width) {
    const Vectors<Scalar> a = vectors_at<Scalar>(triangles.a, i);
    const Vectors<Scalar> b = vectors_at<Scalar>(triangles.b, i);
    const Vectors<Scalar> c = vectors_at<Scalar>(triangles.c, i);
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
      const auto one = [&](Real x, Real y, Real z) TOUCHSTONE_TARGET {
        return Lanes::select(c_over_both, z, Lanes::select(b_over_a, y, x));
      };
      return Vectors<Scalar>{one(of_a.x, of_b.x, of_c.x), one(of_a.y, of_b.y, of_c.y),
                             one(of_a.z, of_b.z, of_c.z)};
    };
    const Real length = Lanes::select(c_over_both, opposite_c, of_two);
    const Vectors<Scalar> longest = choose(bc, ca, ab);
    const Vectors<Scalar> base = choose(a, b, c);
    Vectors<Scalar> normal = cross<Scalar>(choose(ca, ab, bc), choose(ab, bc, ca));
    const Real along = dot<Scalar>(normal, longest) / length;
    normal = {normal.x - along * longest.x, normal.y - along * longest.y,
              normal.z - along * longest.z};
    const Real squared = dot<Scalar>(normal, normal);
    const Real norm = Lanes::sqrt(squared);
    normal = {normal.x / norm, normal.y / norm, normal.z / norm};
    const Real distance = Lanes::select(Lanes::less(Lanes::broadcast(flat) * length, squared),
                                        dot<Scalar>(normal, base),
                                        Lanes::broadcast(std::numeric_limits<Scalar>::quiet_NaN()));
    std::memcpy(normals.x.data() + i, &normal.x, sizeof normal.x);
    std::memcpy(normals.y.data() + i, &normal.y, sizeof normal.y);
    std::memcpy(normals.z.data() + i, &normal.z, sizeof normal.z);
    std::memcpy(distances + i, &distance, sizeof distance);
  }
}

template <class Scalar>
constexpr Loops<Scalar> loops{least_key<Scalar>, seen_from<Scalar>, planes_through<Scalar>};
