// What every loop over real_lanes.h begins with: quads, and vectors of three dimensions. Included
// by it once for each level of vector instructions.

template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Quad<Scalar> convert(const Quad<double>& q) {
  return __builtin_convertvector(q, Quad<Scalar>);
}
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Quad<double> widen(const Quad<Scalar>& q) {
  return __builtin_convertvector(q, Quad<double>);
}

// Four vectors from a quad for each lane.
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void columns_of(const Quad<Scalar>* quads,
                                                    typename RealLanes<Scalar>::Real columns[4]) {
  for (std::size_t k = 0; k < 4; ++k) columns[k] = RealLanes<Scalar>::join(quads + k);
  RealLanes<Scalar>::transpose(columns);
}

// And back: lane l's quad is at place(l) of them, its place.
template <class Lanes>
constexpr std::size_t place(std::size_t lane) {
  return lane % 4 * (Lanes::width / 4) + lane / 4;
}
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void quads_of(typename RealLanes<Scalar>::Real columns[4],
                                                  Quad<Scalar>* quads) {
  using Lanes = RealLanes<Scalar>;
  Lanes::transpose(columns);
  for (std::size_t k = 0; k < 4; ++k) {
    std::memcpy(quads + k * (Lanes::width / 4), &columns[k], sizeof columns[k]);
  }
}

// Four vectors from quads that are at their places.
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void placed_columns(
    const Quad<Scalar>* quads, typename RealLanes<Scalar>::Real columns[4]) {
  using Lanes = RealLanes<Scalar>;
  for (std::size_t k = 0; k < 4; ++k) {
    std::memcpy(&columns[k], quads + k * (Lanes::width / 4), sizeof columns[k]);
  }
  Lanes::transpose(columns);
}

// A vector of three dimensions in each lane.
template <class Scalar>
struct Vectors {
  using Real = typename RealLanes<Scalar>::Real;
  Real x, y, z;
};

template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE typename RealLanes<Scalar>::Real dot(const Vectors<Scalar>& a,
                                                                         const Vectors<Scalar>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
