// Vectors of three dimensions, one a lane: the arithmetic that loops over real_lanes.h share.
// Included by them once for each level of vector instructions.

template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Vectors<Scalar> moved(const Vectors<Scalar>& from,
                                                          typename RealLanes<Scalar>::Real by,
                                                          const Vectors<Scalar>& along) {
  return {from.x + by * along.x, from.y + by * along.y, from.z + by * along.z};
}
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Vectors<Scalar> difference(const Vectors<Scalar>& a,
                                                               const Vectors<Scalar>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Vectors<Scalar> scaled(typename RealLanes<Scalar>::Real by,
                                                           const Vectors<Scalar>& v) {
  return {by * v.x, by * v.y, by * v.z};
}
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Vectors<Scalar> cross(const Vectors<Scalar>& a,
                                                          const Vectors<Scalar>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Vectors<Scalar> select(typename RealLanes<Scalar>::Mask mask,
                                                           const Vectors<Scalar>& a,
                                                           const Vectors<Scalar>& b) {
  using Lanes = RealLanes<Scalar>;
  return {Lanes::select(mask, a.x, b.x), Lanes::select(mask, a.y, b.y),
          Lanes::select(mask, a.z, b.z)};
}

// Masks as what has the operators of bits.
template <class Mask>
struct MaskBits {
  typedef long long Type __attribute__((vector_size(sizeof(Mask))));
};
template <std::integral Mask>
struct MaskBits<Mask> {
  using Type = Mask;
};

// Lanes of both masks; of either; of the first but not of the second.
template <class Mask>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Mask both(Mask a, Mask b) {
  using Bits = typename MaskBits<Mask>::Type;
  return std::bit_cast<Mask>(static_cast<Bits>(std::bit_cast<Bits>(a) & std::bit_cast<Bits>(b)));
}
template <class Mask>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Mask either(Mask a, Mask b) {
  using Bits = typename MaskBits<Mask>::Type;
  return std::bit_cast<Mask>(static_cast<Bits>(std::bit_cast<Bits>(a) | std::bit_cast<Bits>(b)));
}
template <class Mask>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Mask without(Mask a, Mask b) {
  using Bits = typename MaskBits<Mask>::Type;
  return std::bit_cast<Mask>(static_cast<Bits>(std::bit_cast<Bits>(a) & ~std::bit_cast<Bits>(b)));
}
