// The planes of triangles, one per lane, computed like triangle_plane of simplex.h: from the corner
// opposite the longest edge, so that slivers lose no digits. Included by face_planes.inl and by
// gjk-lanes once for each level of vector instructions; results are equal at every level.
#include "algorithms/kernels/simd/lane_vectors.inl"

template <class Scalar>
struct TrianglePlanes {
  using Real = typename RealLanes<Scalar>::Real;
  Vectors<Scalar> normal;  // unit, towards the side from which the corners are anticlockwise
  Real distance;           // from the origin along the normal; NaN if the triangle is flat
  Real length, squared;    // squares of the longest edge, and of that times the height over it
};

template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE TrianglePlanes<Scalar> triangle_planes(
    const Vectors<Scalar>& a, const Vectors<Scalar>& b, const Vectors<Scalar>& c) {
  using Lanes = RealLanes<Scalar>;
  using Real = typename Lanes::Real;
  constexpr Scalar flat = flat_height<Scalar> * flat_height<Scalar>;
  const Vectors<Scalar> bc = difference<Scalar>(c, b), ca = difference<Scalar>(a, c),
                        ab = difference<Scalar>(b, a);
  const Real opposite_a = dot<Scalar>(bc, bc);
  const Real opposite_b = dot<Scalar>(ca, ca);
  const Real opposite_c = dot<Scalar>(ab, ab);
  const auto b_over_a = Lanes::less(opposite_a, opposite_b);
  const Real of_two = Lanes::select(b_over_a, opposite_b, opposite_a);
  const auto c_over_both = Lanes::less(of_two, opposite_c);
  const auto choose = [&](const Vectors<Scalar>& of_a, const Vectors<Scalar>& of_b,
                          const Vectors<Scalar>& of_c) TOUCHSTONE_TARGET {
    return select<Scalar>(c_over_both, of_c, select<Scalar>(b_over_a, of_b, of_a));
  };
  const Real one = Lanes::broadcast(1);
  TrianglePlanes<Scalar> planes;
  planes.length = Lanes::select(c_over_both, opposite_c, of_two);
  const Real inverse = one / planes.length;
  const Vectors<Scalar> longest = choose(bc, ca, ab);
  const Vectors<Scalar> base = choose(a, b, c);
  Vectors<Scalar> normal = cross<Scalar>(choose(ca, ab, bc), choose(ab, bc, ca));
  normal = moved<Scalar>(normal, -(dot<Scalar>(normal, longest) * inverse), longest);
  planes.squared = dot<Scalar>(normal, normal);
  const Real scale = Lanes::sqrt(planes.squared) * (one / planes.squared);
  planes.distance =
      Lanes::select(Lanes::less(Lanes::broadcast(flat) * planes.length, planes.squared),
                    dot<Scalar>(normal, base) * scale,
                    Lanes::broadcast(std::numeric_limits<Scalar>::quiet_NaN()));
  planes.normal = scaled<Scalar>(scale, normal);
  return planes;
}
