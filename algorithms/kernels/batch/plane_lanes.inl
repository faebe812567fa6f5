// The loop of plane_lanes.h. plane_lanes.cpp includes this file once for each level of vector
// instructions, inside that level's namespace.
#include "algorithms/kernels/batch/pair_lanes.inl"
#include "algorithms/kernels/simd/vector3.inl"

// The squares of what a normal, seen from a body, is off from what the body carries. The columns are
// those of the body's matrix.
TOUCHSTONE_TARGET TOUCHSTONE_INLINE typename Simd<double>::Vector square_off(
    const Vector3<double> columns[3], const Vector3<double>& normal, const Vector3<double>& kept) {
  const Vector3<double> off{dot<double>(columns[0], normal) - kept.x,
                            dot<double>(columns[1], normal) - kept.y,
                            dot<double>(columns[2], normal) - kept.z};
  return dot<double>(off, off);
}

// The bits that are set in an entry of a matrix, given by its columns.
using Bits __attribute__((vector_size(8 * Simd<double>::width))) = std::int64_t;
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Bits entry_bits(const Vector3<double> columns[3]) {
  Bits bits{};
  for (int k = 0; k < 3; ++k) {
    bits |= std::bit_cast<Bits>(columns[k].x) | std::bit_cast<Bits>(columns[k].y) |
            std::bit_cast<Bits>(columns[k].z);
  }
  return bits;
}

// Transposes the four numbers from `first` on at each lane's address into four vectors.
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void quads_at(const double* const* from, std::size_t first,
                                                  typename Simd<double>::Vector columns[4]) {
  using Lanes = Simd<double>;
  const double* at[Lanes::width];
  for (std::size_t lane = 0; lane < Lanes::width; ++lane) at[lane] = from[lane] + first;
  for (std::size_t k = 0; k < 4; ++k) columns[k] = Lanes::concat_at(at + k);
  Lanes::transpose(columns);
}

// Writes where to look for a plane between the pairs from `begin` on.
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void write_directions(const Vector3<double>& normal,
                                                          std::size_t begin, std::size_t end,
                                                          std::array<float, 4>* directions) {
  using Lanes = Simd<double>;
  using Vector = typename Lanes::Vector;
  const Vector zero = Lanes::broadcast(0), square = dot<double>(normal, normal);
  const auto usable =
      both(Lanes::less(Lanes::broadcast(0.5), square), Lanes::less(square, Lanes::broadcast(5)));
  const Vector3<double> direction = select<double>(usable, normal, {zero, zero, zero});
  Vector columns[4] = {direction.x, direction.y, direction.z, zero};
  alignas(64) Quad<double> quads[Lanes::width];
  quads_of<double>(columns, quads);
  for (std::size_t lane = 0; lane < end - begin; ++lane) {
    const Quad<float> four = convert<float>(quads[place<Lanes>(lane)]);
    std::memcpy(&directions[begin + lane], &four, sizeof four);
  }
}

// Returns the lanes whose planes part the pairs from `begin` to `end` if the planes are to be
// believed, as bits. The formulas are explained at carried_plane.inl.
TOUCHSTONE_TARGET TOUCHSTONE_INLINE unsigned parted_lanes(const PlaneTable& table,
                                                          const PairTable<double>& bodies,
                                                          std::size_t begin, std::size_t end,
                                                          std::array<float, 4>* directions) {
  using Lanes = Simd<double>;
  using Vector = typename Lanes::Vector;
  constexpr std::size_t width = Lanes::width;
  alignas(64) Quad<double> numbers[3][width];
  const double *poses_a[width], *poses_b[width];
  Group<double> group;
  start_group<double>(bodies, begin, group);
  const std::size_t last = table.memory_of.size() - 1;
  for (std::size_t lane = 0; lane < width; ++lane) {
    poses_a[lane] = bodies.pairs.poses[group.first[lane]].rotation.data();
    poses_b[lane] = bodies.pairs.poses[group.second[lane]].rotation.data();
    const std::byte* const memory =
        table.memory + PlaneTable::memory_bytes * table.memory_of[std::min(begin + lane, last)];
    for (std::size_t k = 0; k < 3; ++k) {
      Quad<float> four;
      std::memcpy(&four, memory + k * sizeof four, sizeof four);
      numbers[k][lane] = widen<float>(four);
    }
  }
  Vector c[9][4];
  for (std::size_t k = 0; k < 3; ++k) {
    quads_at(poses_a, 4 * k, c[k]);
    quads_at(poses_b, 4 * k, c[3 + k]);
    columns_of<double>(numbers[k], c[6 + k]);
  }
  const Vector3<double> of_a[3] = {
      {c[0][0], c[0][1], c[0][2]}, {c[0][3], c[1][0], c[1][1]}, {c[1][2], c[1][3], c[2][0]}};
  const Vector3<double> of_b[3] = {
      {c[3][0], c[3][1], c[3][2]}, {c[3][3], c[4][0], c[4][1]}, {c[4][2], c[4][3], c[5][0]}};
  const Vector3<double> offset{c[5][1] - c[2][1], c[5][2] - c[2][2], c[5][3] - c[2][3]};
  const Vector3<double> in_a{c[6][0], c[6][1], c[6][2]}, in_b{c[6][3], c[7][0], c[7][1]};
  const Vector reach = c[7][2], radius_a = c[7][3], radius_b = c[8][0];

  const Vector3<double> normal = moved<double>(
      moved<double>(scaled<double>(in_a.x, of_a[0]), in_a.y, of_a[1]), in_a.z, of_a[2]);
  const Vector off_a = square_off(of_a, normal, in_a), off_b = square_off(of_b, normal, in_b);
  constexpr double rounding = CarriedPlane::rounding;
  const Vector one = Lanes::broadcast(1), zero = Lanes::broadcast(0);
  const Vector radii = radius_a + radius_b;
  const Vector length = Lanes::abs(offset.x) + Lanes::abs(offset.y) + Lanes::abs(offset.z);
  const Vector excess = dot<double>(normal, normal) - one;
  const Vector gap = dot<double>(normal, offset) - reach - radii * Lanes::abs(excess) -
                     2 * rounding * length - table.margin * (one + Lanes::abs(excess));
  const Vector bend = radius_a * radius_a * off_a + radius_b * radius_b * off_b;
  const auto far =
      both(Lanes::less(zero, gap), Lanes::less((2 * (1 + rounding)) * bend, gap * gap));
  // These bits together make a number below two if each entry is.
  const Vector entries = std::bit_cast<Vector>(entry_bits(of_a) | entry_bits(of_b));
  const auto sound =
      both(Lanes::less(excess, one), Lanes::less(Lanes::abs(entries), Lanes::broadcast(2)));
  const unsigned parted = Lanes::to_bits(both(far, sound));
  if (directions != nullptr && (~parted & ((1u << (end - begin)) - 1)) != 0) {
    const Vector3<double> both_carry = moved<double>(
        moved<double>(moved<double>(normal, in_b.x, of_b[0]), in_b.y, of_b[1]), in_b.z, of_b[2]);
    write_directions(both_carry, begin, end, directions);
  }
  return parted;
}

TOUCHSTONE_TARGET std::size_t part_pairs(const PlaneTable& table, Outcome* outcomes,
                                         const PlaneRest& rest) {
  constexpr std::size_t width = Simd<double>::width;
  const BodyPairs& pairs = table.pairs;
  const PairTable<double> bodies{pairs, nullptr, nullptr, nullptr};
  const std::size_t size = pairs.first.size();
  std::size_t count = 0;
  for (std::size_t begin = 0; begin < size; begin += width) {
    for (std::size_t i = begin + width; i < std::min(begin + 2 * width, size); ++i) {
      prefetch(&pairs.poses[pairs.first[i]], sizeof(Pose));
      prefetch(&pairs.poses[pairs.second[i]], sizeof(Pose));
      prefetch(&plane_of(table, i), 1);
    }
    const std::size_t end = std::min(begin + width, size);
    const unsigned parted = parted_lanes(table, bodies, begin, end, rest.directions);
    for (std::size_t i = begin; i < end; ++i) {
      const bool parts = (parted >> (i - begin) & 1) != 0;
      if (parts && plane_of(table, i).is_own()) {
        write_parted(outcomes[i]);
        continue;
      }
      rest.left[count++] = static_cast<std::uint32_t>(i);
      if (parts && rest.directions != nullptr) rest.directions[i] = {};
    }
  }
  return count;
}
