// Quads, and vectors of three dimensions, with which every loop over vector.h begins. vector.h
// includes this file once for each level of vector instructions.

template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Quad<Scalar> convert(const Quad<double>& q) {
  return __builtin_convertvector(q, Quad<Scalar>);
}
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Quad<double> widen(const Quad<Scalar>& q) {
  return __builtin_convertvector(q, Quad<double>);
}

// Transposes a quad for each lane into four vectors.
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void columns_of(const Quad<Scalar>* quads,
                                                    typename Simd<Scalar>::Vector columns[4]) {
  for (std::size_t k = 0; k < 4; ++k) columns[k] = Simd<Scalar>::concat(quads + k);
  Simd<Scalar>::transpose(columns);
}

// place(l) is the index at which quads_of stores lane l's quad.
template <class Lanes>
constexpr std::size_t place(std::size_t lane) {
  return lane % 4 * (Lanes::width / 4) + lane / 4;
}
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void quads_of(typename Simd<Scalar>::Vector columns[4],
                                                  Quad<Scalar>* quads) {
  using Lanes = Simd<Scalar>;
  Lanes::transpose(columns);
  for (std::size_t k = 0; k < 4; ++k) {
    std::memcpy(quads + k * (Lanes::width / 4), &columns[k], sizeof columns[k]);
  }
}

// Loads four vectors from quads that are at their places.
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void placed_columns(const Quad<Scalar>* quads,
                                                        typename Simd<Scalar>::Vector columns[4]) {
  using Lanes = Simd<Scalar>;
  for (std::size_t k = 0; k < 4; ++k) {
    std::memcpy(&columns[k], quads + k * (Lanes::width / 4), sizeof columns[k]);
  }
  Lanes::transpose(columns);
}

// A three-dimensional vector in each lane.
template <class Scalar>
struct Vector3 {
  using Vector = typename Simd<Scalar>::Vector;
  Vector x, y, z;
};

template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE typename Simd<Scalar>::Vector dot(const Vector3<Scalar>& a,
                                                                      const Vector3<Scalar>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
