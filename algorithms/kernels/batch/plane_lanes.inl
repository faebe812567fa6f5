// The loop of plane_lanes.h. plane_lanes.cpp includes this file for AVX2 and for AVX-512, inside
// that level's namespace.
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
    bits |=
        bit_cast<Bits>(columns[k].x) | bit_cast<Bits>(columns[k].y) | bit_cast<Bits>(columns[k].z);
  }
  return bits;
}

// Where the numbers of the pairs are, one in each lane. A lane without a pair has the last one.
struct NumbersOfPairs {
  const double *pose_a[Simd<double>::width], *pose_b[Simd<double>::width];
  const std::byte* plane[Simd<double>::width];
};

// Finds the numbers of pair i for a lane, and prefetches them.
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void find_numbers(const PlaneTable& table, std::size_t i,
                                                      std::size_t lane, NumbersOfPairs& numbers) {
  const BodyPairs& pairs = table.pairs;
  const Pose* const poses = pairs.poses.data();
  const Pose &a = poses[pairs.first[i]], &b = poses[pairs.second[i]];
  prefetch(&a, sizeof a);
  prefetch(&b, sizeof b);
  numbers.pose_a[lane] = a.rotation.data();
  numbers.pose_b[lane] = b.rotation.data();
  numbers.plane[lane] = memory_of(table, i);
  prefetch(numbers.plane[lane], 1);
}

// Does so for the pairs from `begin` on.
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void find_numbers(const PlaneTable& table, std::size_t begin,
                                                      NumbersOfPairs& numbers) {
  constexpr std::size_t width = Simd<double>::width;
  const std::size_t size = table.pairs.first.size();
  if (size - begin >= width) {
    for (std::size_t lane = 0; lane < width; ++lane) {
      find_numbers(table, begin + lane, lane, numbers);
    }
  } else {
    for (std::size_t lane = 0; lane < width; ++lane) {
      find_numbers(table, std::min(begin + lane, size - 1), lane, numbers);
    }
  }
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

// The vectors of floats with as many lanes.
template <class Lanes>
using FloatLanes =
    std::conditional_t<Lanes::width == 8, simd::avx2::Simd<float>, simd::baseline::Simd<float>>;

// Transposes the four floats from `first` on at each lane's address. They are widened after that,
// because shuffles of doubles move twice as many bytes.
template <class Lanes>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void floats_at(const std::byte* const* from, std::size_t first,
                                                   typename FloatLanes<Lanes>::Vector columns[4]) {
  Quad<float> quads[Lanes::width];
  for (std::size_t lane = 0; lane < Lanes::width; ++lane) {
    std::memcpy(&quads[lane], from[lane] + first * sizeof(float), sizeof quads[lane]);
  }
  if constexpr (Lanes::width == 4) {
    const Quad<float> a = __builtin_shufflevector(quads[0], quads[1], 0, 4, 1, 5);
    const Quad<float> b = __builtin_shufflevector(quads[0], quads[1], 2, 6, 3, 7);
    const Quad<float> c = __builtin_shufflevector(quads[2], quads[3], 0, 4, 1, 5);
    const Quad<float> d = __builtin_shufflevector(quads[2], quads[3], 2, 6, 3, 7);
    columns[0] = __builtin_shufflevector(a, c, 0, 1, 4, 5);
    columns[1] = __builtin_shufflevector(a, c, 2, 3, 6, 7);
    columns[2] = __builtin_shufflevector(b, d, 0, 1, 4, 5);
    columns[3] = __builtin_shufflevector(b, d, 2, 3, 6, 7);
  } else {
    for (std::size_t k = 0; k < 4; ++k) columns[k] = FloatLanes<Lanes>::concat(quads + k);
    FloatLanes<Lanes>::transpose(columns);
  }
}

template <class Lanes>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE typename Lanes::Vector widened(
    const typename FloatLanes<Lanes>::Vector& x) {
  if constexpr (Lanes::width == 8) {
    return _mm512_cvtps_pd(x);
  } else {
    return widen<float>(x);
  }
}

// The products of the floats' bits, as integers, with a number.
template <class Lanes>
struct WithIntegers {
  typedef std::uint64_t Integers __attribute__((vector_size(8 * Lanes::width)));
};
template <class Lanes>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE typename WithIntegers<Lanes>::Integers bits_times(
    const typename FloatLanes<Lanes>::Vector& x, std::uint32_t number) {
  using Integers = typename WithIntegers<Lanes>::Integers;
  if constexpr (Lanes::width == 8) {
    const __m512i bits = _mm512_cvtepu32_epi64(bit_cast<__m256i>(x));
    return bit_cast<Integers>(_mm512_mul_epu32(bits, _mm512_set1_epi64(number)));
  } else {
    const __m256i bits = _mm256_cvtepu32_epi64(bit_cast<__m128i>(x));
    return bit_cast<Integers>(_mm256_mul_epu32(bits, _mm256_set1_epi64x(number)));
  }
}

// Returns the lanes whose planes, by their ten words, are as CarriedPlane::make wrote them.
template <class Lanes>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE typename Lanes::Mask own_lanes(
    const typename FloatLanes<Lanes>::Vector* words) {
  using Integers = typename WithIntegers<Lanes>::Integers;
  Integers sum = bits_times<Lanes>(words[0], CarriedPlane::factors[0]) + CarriedPlane::sum_of_zeros;
  for (std::size_t k = 1; k < CarriedPlane::factors.size(); ++k) {
    sum += bits_times<Lanes>(words[k], CarriedPlane::factors[k]);
  }
  constexpr std::uint64_t low = 0xffffffff;
  for (int turn = 0; turn < 2; ++turn) sum = (sum >> 32) + (sum & low);
  // The bits that differ, which are less than 34, are the last places of a number from one to two.
  const Integers off = sum ^ bits_times<Lanes>(words[CarriedPlane::factors.size()], 1);
  const typename Lanes::Vector one = Lanes::broadcast(1);
  return Lanes::less_equal(bit_cast<typename Lanes::Vector>(off | bit_cast<Integers>(one)), one);
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

// Returns the lanes whose planes part the pairs from `begin` to `end`, as bits. The formulas are
// explained at carried_plane.inl.
TOUCHSTONE_TARGET TOUCHSTONE_INLINE unsigned parted_lanes(const NumbersOfPairs& numbers,
                                                          double margin, std::size_t begin,
                                                          std::size_t end,
                                                          std::array<float, 4>* directions) {
  using Lanes = Simd<double>;
  using Vector = typename Lanes::Vector;
  Vector c[6][4];
  typename FloatLanes<Lanes>::Vector words[12];
#pragma GCC unroll 3
  for (std::size_t k = 0; k < 3; ++k) {
    quads_at(numbers.pose_a, 4 * k, c[k]);
    quads_at(numbers.pose_b, 4 * k, c[3 + k]);
    floats_at<Lanes>(numbers.plane, 4 * k, words + 4 * k);
  }
  const Vector3<double> of_a[3] = {
      {c[0][0], c[0][1], c[0][2]}, {c[0][3], c[1][0], c[1][1]}, {c[1][2], c[1][3], c[2][0]}};
  const Vector3<double> of_b[3] = {
      {c[3][0], c[3][1], c[3][2]}, {c[3][3], c[4][0], c[4][1]}, {c[4][2], c[4][3], c[5][0]}};
  const Vector3<double> offset{c[5][1] - c[2][1], c[5][2] - c[2][2], c[5][3] - c[2][3]};
  const Vector3<double> in_a{widened<Lanes>(words[0]), widened<Lanes>(words[1]),
                             widened<Lanes>(words[2])};
  const Vector3<double> in_b{widened<Lanes>(words[3]), widened<Lanes>(words[4]),
                             widened<Lanes>(words[5])};
  const Vector reach = widened<Lanes>(words[6]), radius_a = widened<Lanes>(words[7]),
               radius_b = widened<Lanes>(words[8]);

  const Vector3<double> normal = moved<double>(
      moved<double>(scaled<double>(in_a.x, of_a[0]), in_a.y, of_a[1]), in_a.z, of_a[2]);
  const Vector off_a = square_off(of_a, normal, in_a), off_b = square_off(of_b, normal, in_b);
  constexpr double rounding = CarriedPlane::rounding;
  const Vector one = Lanes::broadcast(1), zero = Lanes::broadcast(0);
  const Vector radii = radius_a + radius_b;
  const Vector length = Lanes::abs(offset.x) + Lanes::abs(offset.y) + Lanes::abs(offset.z);
  const Vector excess = dot<double>(normal, normal) - one;
  const Vector gap = dot<double>(normal, offset) - reach - radii * Lanes::abs(excess) -
                     2 * rounding * length - margin * (one + Lanes::abs(excess));
  const Vector bend = radius_a * radius_a * off_a + radius_b * radius_b * off_b;
  const auto far =
      both(Lanes::less(zero, gap), Lanes::less((2 * (1 + rounding)) * bend, gap * gap));
  // These bits together make a number below two if each entry is.
  const Vector entries = bit_cast<Vector>(entry_bits(of_a) | entry_bits(of_b));
  const auto sound =
      both(Lanes::less(excess, one), Lanes::less(Lanes::abs(entries), Lanes::broadcast(2)));
  const unsigned parted = Lanes::to_bits(both(both(far, sound), own_lanes<Lanes>(words)));
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
  const std::size_t size = table.pairs.first.size();
  std::size_t count = 0;
  // The numbers of pairs are fetched while those of about 30 pairs before them are used.
  constexpr std::size_t groups = 32 / width;
  NumbersOfPairs numbers[groups];
  for (std::size_t k = 0; k + 1 < groups && k * width < size; ++k) {
    find_numbers(table, k * width, numbers[k]);
  }
  for (std::size_t begin = 0; begin < size; begin += width) {
    const NumbersOfPairs& own = numbers[begin / width % groups];
    const std::size_t ahead = begin + (groups - 1) * width;
    if (ahead < size) find_numbers(table, ahead, numbers[ahead / width % groups]);
    const std::size_t end = std::min(begin + width, size);
    const unsigned parted = parted_lanes(own, table.margin, begin, end, rest.directions);
    const unsigned all = (1u << (end - begin)) - 1;
    if ((~parted & all) == 0) {
      for (std::size_t i = begin; i < end; ++i) write_parted(outcomes[i]);
      continue;
    }
    for (std::size_t i = begin; i < end; ++i) {
      if ((parted >> (i - begin) & 1) != 0) {
        write_parted(outcomes[i]);
      } else {
        rest.left[count++] = static_cast<std::uint32_t>(i);
      }
    }
  }
  return count;
}
