// The arithmetic on vectors of three dimensions, one per lane, that several loops share. They
// include this file once for each level of vector instructions.

template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Vector3<Scalar> moved(const Vector3<Scalar>& from,
                                                          typename Simd<Scalar>::Vector by,
                                                          const Vector3<Scalar>& along) {
  return {from.x + by * along.x, from.y + by * along.y, from.z + by * along.z};
}
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Vector3<Scalar> difference(const Vector3<Scalar>& a,
                                                               const Vector3<Scalar>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Vector3<Scalar> scaled(typename Simd<Scalar>::Vector by,
                                                           const Vector3<Scalar>& v) {
  return {by * v.x, by * v.y, by * v.z};
}
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Vector3<Scalar> cross(const Vector3<Scalar>& a,
                                                          const Vector3<Scalar>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Vector3<Scalar> select(typename Simd<Scalar>::Mask mask,
                                                           const Vector3<Scalar>& a,
                                                           const Vector3<Scalar>& b) {
  using Lanes = Simd<Scalar>;
  return {Lanes::select(mask, a.x, b.x), Lanes::select(mask, a.y, b.y),
          Lanes::select(mask, a.z, b.z)};
}

// The type in which a mask has the bitwise operators.
template <class Mask>
struct MaskBits {
  typedef long long Type __attribute__((vector_size(sizeof(Mask))));
};
template <std::integral Mask>
struct MaskBits<Mask> {
  using Type = Mask;
};

// The lanes of both masks; of either; of the first but not the second.
template <class Mask>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Mask both(Mask a, Mask b) {
  using Bits = typename MaskBits<Mask>::Type;
  return bit_cast<Mask>(static_cast<Bits>(bit_cast<Bits>(a) & bit_cast<Bits>(b)));
}
template <class Mask>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Mask either(Mask a, Mask b) {
  using Bits = typename MaskBits<Mask>::Type;
  return bit_cast<Mask>(static_cast<Bits>(bit_cast<Bits>(a) | bit_cast<Bits>(b)));
}
template <class Mask>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Mask without(Mask a, Mask b) {
  using Bits = typename MaskBits<Mask>::Type;
  return bit_cast<Mask>(static_cast<Bits>(bit_cast<Bits>(a) & ~bit_cast<Bits>(b)));
}
