// Points in lanes, and signs of volumes. The loops of this room include this file once for each level of
// vector instructions.

using Lanes = Simd<double>;
using Vector = typename Lanes::Vector;
constexpr unsigned lane_bits = (1u << Lanes::width) - 1;

struct Points {
  Vector x, y, z;
};

TOUCHSTONE_TARGET TOUCHSTONE_INLINE Vector load_doubles(const double* from) {
  return Lanes::load(from);
}
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Vector load_doubles(const float* from) {
  using Narrow = float __attribute__((vector_size(Lanes::width * sizeof(float))));
  using Wide = double __attribute__((vector_size(Lanes::width * sizeof(double))));
  Narrow x;
  __builtin_memcpy(&x, from, sizeof x);
  return bit_cast<Vector>(__builtin_convertvector(x, Wide));
}
template <class Block>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Points points_at(const Block& block, std::size_t corner,
                                                     std::size_t lane) {
  return {load_doubles(&block.at[3 * corner][lane]), load_doubles(&block.at[3 * corner + 1][lane]),
          load_doubles(&block.at[3 * corner + 2][lane])};
}
template <class Block>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Points point_of(const Block& block, std::size_t corner,
                                                    std::size_t lane) {
  return {Lanes::broadcast(block.at[3 * corner][lane]),
          Lanes::broadcast(block.at[3 * corner + 1][lane]),
          Lanes::broadcast(block.at[3 * corner + 2][lane])};
}
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Points minus(const Points& p, const Points& q) {
  return {p.x - q.x, p.y - q.y, p.z - q.z};
}
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Points cross(const Points& p, const Points& q) {
  return {p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x};
}
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Vector dot(const Points& p, const Points& q) {
  return p.x * q.x + p.y * q.y + p.z * q.z;
}
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Points least(const Points& p, const Points& q) {
  return {Lanes::min(p.x, q.x), Lanes::min(p.y, q.y), Lanes::min(p.z, q.z)};
}
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Points greatest(const Points& p, const Points& q) {
  return {Lanes::max(p.x, q.x), Lanes::max(p.y, q.y), Lanes::max(p.z, q.z)};
}

// The lanes in which a volume is surely positive, and surely negative.
struct Sign {
  unsigned plus, minus;
};
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Sign sign_of(Vector volume, Vector bound, Vector below) {
  return {Lanes::to_bits(Lanes::less(bound, volume)), Lanes::to_bits(Lanes::less(volume, below))};
}
