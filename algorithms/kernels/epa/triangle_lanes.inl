// The planes of triangles, one per lane, computed like triangle_plane of simplex.h: from the corner
// opposite the longest edge, so that slivers lose no digits. Included by face_planes.inl and by
// gjk-lanes once for each level of vector instructions; results are equal at every level.
#include "algorithms/kernels/simd/vector3.inl"

template <class Scalar>
struct TrianglePlanes {
  using Vector = typename Simd<Scalar>::Vector;
  Vector3<Scalar> normal;  // unit, towards the side from which the corners are anticlockwise
  Vector distance;         // from the origin along the normal; NaN if the triangle is flat
  Vector length, squared;  // squares of the longest edge, and of that times the height over it
};

template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE TrianglePlanes<Scalar> triangle_planes(
    const Vector3<Scalar>& a, const Vector3<Scalar>& b, const Vector3<Scalar>& c) {
  using Lanes = Simd<Scalar>;
  using Vector = typename Lanes::Vector;
  constexpr Scalar flat = flat_height<Scalar> * flat_height<Scalar>;
  const Vector3<Scalar> bc = difference<Scalar>(c, b), ca = difference<Scalar>(a, c),
                        ab = difference<Scalar>(b, a);
  const Vector opposite_a = dot<Scalar>(bc, bc);
  const Vector opposite_b = dot<Scalar>(ca, ca);
  const Vector opposite_c = dot<Scalar>(ab, ab);
  const auto b_over_a = Lanes::less(opposite_a, opposite_b);
  const Vector of_two = Lanes::select(b_over_a, opposite_b, opposite_a);
  const auto c_over_both = Lanes::less(of_two, opposite_c);
  const auto choose = [&](const Vector3<Scalar>& of_a, const Vector3<Scalar>& of_b,
                          const Vector3<Scalar>& of_c) TOUCHSTONE_TARGET {
    return select<Scalar>(c_over_both, of_c, select<Scalar>(b_over_a, of_b, of_a));
  };
  const Vector one = Lanes::broadcast(1);
  TrianglePlanes<Scalar> planes;
  planes.length = Lanes::select(c_over_both, opposite_c, of_two);
  const Vector inverse = one / planes.length;
  const Vector3<Scalar> longest = choose(bc, ca, ab);
  const Vector3<Scalar> base = choose(a, b, c);
  Vector3<Scalar> normal = cross<Scalar>(choose(ca, ab, bc), choose(ab, bc, ca));
  normal = moved<Scalar>(normal, -(dot<Scalar>(normal, longest) * inverse), longest);
  planes.squared = dot<Scalar>(normal, normal);
  const Vector scale = Lanes::sqrt(planes.squared) * (one / planes.squared);
  planes.distance =
      Lanes::select(Lanes::less(Lanes::broadcast(flat) * planes.length, planes.squared),
                    dot<Scalar>(normal, base) * scale,
                    Lanes::broadcast(std::numeric_limits<Scalar>::quiet_NaN()));
  planes.normal = scaled<Scalar>(scale, normal);
  return planes;
}
