// The loop of moving_boxes.h. moving_boxes.cpp includes this file once for each level of vector
// instructions, inside that level's namespace.

// The pairs of as many lanes that surely meet, and those that rounding leaves open.
struct LaneVerdicts {
  unsigned meet, open;
};

// Reads four floats at `offset` of a body in each lane: three of a kind, and one that is not used.
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Vector3<float> three_of(
    const std::array<const float*, Simd<float>::width>& bodies, std::size_t offset) {
  using Lanes = Simd<float>;
  std::array<simd::Quad<float>, Lanes::width> quads;
  for (std::size_t lane = 0; lane < Lanes::width; ++lane)
    std::memcpy(&quads[lane], bodies[lane] + offset, sizeof quads[lane]);
  typename Lanes::Vector columns[4];
  columns_of<float>(quads.data(), columns);
  return {columns[0], columns[1], columns[2]};
}

// Narrows the times from `first` to `last` to those at which the intervals of an axis overlap.
// `regular` loses the lanes with 0 / 0 or with numbers that are too great.
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void cut_by_axis(
    typename Simd<float>::Vector gap_ab, typename Simd<float>::Vector gap_ba,
    typename Simd<float>::Vector speed, typename Simd<float>::Vector& first,
    typename Simd<float>::Vector& last, typename Simd<float>::Mask& regular) {
  using Lanes = Simd<float>;
  const auto one = gap_ab / speed, other = -gap_ba / speed;
  const auto size = Lanes::max(Lanes::max_abs(gap_ab, gap_ba), Lanes::abs(speed));
  regular = Lanes::less_equal(regular, size, Lanes::broadcast(0x1p120F));
  regular = Lanes::less_equal(regular, one, one);
  regular = Lanes::less_equal(regular, other, other);
  first = Lanes::max(first, Lanes::min(one, other));
  last = Lanes::min(last, Lanes::max(one, other));
}

// With u = 2^-24: a difference of floats is off by u of itself and has the right sign, and so each
// time is off by (1 + u)^3 / (1 - u) - 1 < 4.1 u of itself, or where it underflows by 2^-150. The
// least and the greatest of numbers are off by no more than the numbers. `slack` is twice that.
TOUCHSTONE_TARGET TOUCHSTONE_INLINE LaneVerdicts
judge(const std::array<const float*, Simd<float>::width>& a,
      const std::array<const float*, Simd<float>::width>& b) {
  using Lanes = Simd<float>;
  using Vector = typename Lanes::Vector;
  const Vector3<float> min_a = three_of(a, 0), max_a = three_of(a, 3), move_a = three_of(a, 6);
  const Vector3<float> min_b = three_of(b, 0), max_b = three_of(b, 3), move_b = three_of(b, 6);
  Vector first = Lanes::broadcast(0), last = Lanes::broadcast(1);
  auto regular = Lanes::less_equal(first, first);
  cut_by_axis(max_b.x - min_a.x, max_a.x - min_b.x, move_a.x - move_b.x, first, last, regular);
  cut_by_axis(max_b.y - min_a.y, max_a.y - min_b.y, move_a.y - move_b.y, first, last, regular);
  cut_by_axis(max_b.z - min_a.z, max_a.z - min_b.z, move_a.z - move_b.z, first, last, regular);
  // Times outside [0, 1] decide as well from a little outside of it.
  first = Lanes::min(first, Lanes::broadcast(2));
  last = Lanes::max(last, Lanes::broadcast(-1));
  const Vector slack = Lanes::max_abs(first, last) * Lanes::broadcast(0x1p-20F) +
                       Lanes::broadcast(0x1p-140F);
  const unsigned meet = Lanes::to_bits(Lanes::less_equal(regular, first + slack, last));
  const unsigned apart = Lanes::to_bits(Lanes::less_equal(regular, last + slack, first));
  constexpr unsigned all = static_cast<unsigned>((std::uint64_t{1} << Lanes::width) - 1);
  return {meet, all & ~(meet | apart)};
}

TOUCHSTONE_TARGET std::size_t keep_whole(const MovingBox* bodies, std::span<const IndexPair> pairs,
                                         PairBuffer& kept) {
  constexpr std::size_t width = Simd<float>::width;
  std::array<const float*, width> a, b;
  std::size_t i = 0;
  for (; i + width <= pairs.size(); i += width) {
    for (std::size_t lane = 0; lane < width; ++lane) {
      a[lane] = reinterpret_cast<const float*>(bodies + pairs[i + lane].a);
      b[lane] = reinterpret_cast<const float*>(bodies + pairs[i + lane].b);
    }
    LaneVerdicts verdicts = judge(a, b);
    for (unsigned bits = verdicts.open; bits != 0; bits &= bits - 1) {
      const auto lane = static_cast<unsigned>(std::countr_zero(bits));
      const IndexPair pair = pairs[i + lane];
      if (moving_boxes_meet(bodies[pair.a], bodies[pair.b])) verdicts.meet |= 1U << lane;
    }
    kept.reserve(width);
    IndexPair* out = kept.end();
    std::size_t count = 0;
    for (unsigned bits = verdicts.meet; bits != 0; bits &= bits - 1)
      out[count++] = pairs[i + static_cast<unsigned>(std::countr_zero(bits))];
    kept.advance(count);
  }
  return i;
}
