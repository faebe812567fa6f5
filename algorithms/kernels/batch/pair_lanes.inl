// The parts that loops over pairs of bodies share. Each loop includes this file once for each level
// of vector instructions.

// The bodies of one pair a lane, from pair `begin` on. The arrays hold copies that repeat the last
// pair if there are fewer pairs than lanes.
template <class Scalar>
struct Group {
  const std::uint32_t *first, *second;
  std::uint32_t padded_first[Simd<Scalar>::width], padded_second[Simd<Scalar>::width];
};
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void start_group(const PairTable<Scalar>& table,
                                                     std::size_t begin, Group<Scalar>& group) {
  constexpr std::size_t width = Simd<Scalar>::width;
  const BodyPairs& pairs = table.pairs;
  group.first = pairs.first.data() + begin;
  group.second = pairs.second.data() + begin;
  if (pairs.first.size() - begin >= width) return;
  for (std::size_t lane = 0; lane < width; ++lane) {
    const std::size_t i = std::min(begin + lane, pairs.first.size() - 1);
    group.padded_first[lane] = pairs.first[i];
    group.padded_second[lane] = pairs.second[i];
  }
  group.first = group.padded_first;
  group.second = group.padded_second;
}

// Returns four numbers of a pose from `first` on: its matrix by columns, then the translation.
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Quad<double> pose_quad(const Pose& pose, std::size_t first) {
  Quad<double> q;
  std::memcpy(&q, reinterpret_cast<const char*>(&pose) + first * sizeof(double), sizeof q);
  return q;
}

TOUCHSTONE_TARGET TOUCHSTONE_INLINE void put_quad(const Quad<double>& q, char* to) {
  std::memcpy(to, &q, sizeof q);
}

// Returns the four numbers of a body's shape.
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Quad<Scalar> shape_quad(const PairTable<Scalar>& table,
                                                            std::uint32_t body) {
  Quad<Scalar> q;
  std::memcpy(&q, table.shapes + std::size_t{4} * table.pairs.shape_of[body], sizeof q);
  return q;
}

// Returns the lanes whose size is such that products and squares stay within the range of a float.
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE unsigned sized_lanes(typename Simd<Scalar>::Vector size) {
  using Lanes = Simd<Scalar>;
  return Lanes::to_bits(Lanes::less(Lanes::broadcast(Scalar(1e-10)), size)) &
         Lanes::to_bits(Lanes::less(size, Lanes::broadcast(Scalar(1e12))));
}

// Returns the lanes whose three vectors are orthonormal up to greatest_skew.
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE unsigned orthonormal_lanes(const Vector3<Scalar> edges[3]) {
  using Lanes = Simd<Scalar>;
  using Vector = typename Lanes::Vector;
  Vector skew = Lanes::broadcast(0), trace = skew;
  for (int k = 0; k < 3; ++k) {
    const Vector square = dot<Scalar>(edges[k], edges[k]);
    trace = trace + square;
    skew = Lanes::max(skew, Lanes::abs(square - Lanes::broadcast(1)));
    skew = Lanes::max(skew, Lanes::abs(dot<Scalar>(edges[k], edges[(k + 1) % 3])));
  }
  // The trace detects infinities and NaN, which a maximum may lose.
  return Lanes::to_bits(Lanes::less(skew, Lanes::broadcast(greatest_skew<Scalar>))) &
         Lanes::to_bits(Lanes::less(trace, Lanes::broadcast(4)));
}

// The numbers of an outcome, in metres: vectors in world axes, points relative to the centre of a.
template <class Scalar>
struct Numbers {
  typename Simd<Scalar>::Vector distance, lower, upper;
  Vector3<Scalar> normal, on_a, on_b;
};

// Writes the numbers of the lanes whose bits are set to the outcomes from pair `begin` on.
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void write_numbers(const PairTable<Scalar>& table,
                                                       std::size_t begin, unsigned lanes,
                                                       const Numbers<Scalar>& numbers) {
  using Lanes = Simd<Scalar>;
  const auto& [distance, lower, upper, normal, on_a, on_b] = numbers;
  typename Lanes::Vector columns[3][4] = {{distance, lower, upper, normal.x},
                                          {normal.y, normal.z, on_a.x, on_a.y},
                                          {on_a.z, on_b.x, on_b.y, on_b.z}};
  alignas(64) Quad<Scalar> quads[3][Lanes::width];
  for (std::size_t k = 0; k < 3; ++k) quads_of<Scalar>(columns[k], quads[k]);
  const std::size_t count = table.pairs.first.size() - begin;
  if (count < Lanes::width) lanes &= (1u << count) - 1;
  for (; lanes != 0; lanes &= lanes - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(lanes));
    const Quad<double> origin = pose_quad(table.pairs.poses[table.pairs.first[begin + lane]], 8);
    const Quad<double> none{};
    const std::size_t at = place<Lanes>(lane);
    const Quad<double> to_a = __builtin_shufflevector(none, origin, 0, 0, 5, 6);
    const Quad<double> to_b = __builtin_shufflevector(origin, origin, 3, 1, 2, 3);
    char* const to = reinterpret_cast<char*>(&table.outcomes[begin + lane].distance);
    put_quad(widen<Scalar>(quads[0][at]), to);
    put_quad(widen<Scalar>(quads[1][at]) + to_a, to + sizeof to_a);
    put_quad(widen<Scalar>(quads[2][at]) + to_b, to + 2 * sizeof to_a);
  }
}

// Writes the answer of the lowest bit.
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void write_answer(unsigned overlapping, Outcome& outcome) {
  static_assert(static_cast<int>(Answer::separated) == 0 && static_cast<int>(Status::ok) == 0);
  static_assert(offsetof(Outcome, status) == offsetof(Outcome, answer) + sizeof(Answer));
  // One write sets answer and status.
  constexpr unsigned common = static_cast<unsigned>(Answer::overlapping)
                              << (std::endian::native == std::endian::big ? 8 : 0);
  const auto both = static_cast<std::uint16_t>((overlapping & 1) * common);
  std::memcpy(&outcome.answer, &both, sizeof both);
  outcome.iterations = 0;
  outcome.support_calls = -1;
}

// Writes the answers of the pairs from `begin` on that have one. Appends the places of the others
// to the `left` that are there, and returns the new number.
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE std::size_t write_answers(const PairTable<Scalar>& table,
                                                              std::size_t begin, unsigned apart,
                                                              unsigned overlapping,
                                                              std::size_t left) {
  constexpr std::size_t width = Simd<Scalar>::width;
  const std::size_t end = std::min(width, table.pairs.first.size() - begin);
  const unsigned answered = apart | overlapping;
  if (end == width && (~answered & ((1u << width) - 1)) == 0) {
    for (std::size_t lane = 0; lane < width; ++lane) {
      write_answer(~apart >> lane, table.outcomes[begin + lane]);
    }
    return left;
  }
  for (std::size_t lane = 0; lane < end; ++lane) {
    if ((answered >> lane & 1) != 0) {
      write_answer(~apart >> lane, table.outcomes[begin + lane]);
    } else {
      table.left[left++] = static_cast<std::uint32_t>(begin + lane);
    }
  }
  return left;
}
