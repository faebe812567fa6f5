// Part of hull_scan.h: the scan in floats, which read half as much and fill vectors twice as wide.
// Doubles decide between those that floats do not tell apart. hull_scan.inl includes this file.

// Returns the index that furthest_at(blocks, x, y, z) does. `rough` are the same vertices, rounded
// to floats, at most `most_blocks`; coordinates are at most 1 in magnitude.
//
// Let s be |x| + |y| + |z|, in a range where no product of weight is lost to underflow. A value in
// floats is off from that in double by at most 6 u s, u = 2^-24: a rounding each of the direction,
// the vertex, the product and two sums, and those in double. A vertex whose value is less than the
// greatest by twice that, and by what rounding takes of s and of the difference, 16 u s in all, is
// not the furthest.
TOUCHSTONE_TARGET inline std::uint32_t furthest_by_floats(
    const VertexBlock<float>* rough, std::span<const VertexBlock<double>> blocks, double x,
    double y, double z) {
  using Lanes = Simd<float>;
  using Vector = typename Lanes::Vector;
  constexpr std::size_t size = VertexBlock<float>::size, parts = size / Lanes::width;
  const auto length = static_cast<float>(std::abs(x) + std::abs(y) + std::abs(z));
  if (!(length > 0x1p-60f && length < 0x1p60f)) return furthest_at(blocks, x, y, z).index;
  Vector values[most_blocks * parts];
  const Vector dx = Lanes::broadcast(static_cast<float>(x));
  const Vector dy = Lanes::broadcast(static_cast<float>(y));
  const Vector dz = Lanes::broadcast(static_cast<float>(z));
  Vector best = Lanes::broadcast(-std::numeric_limits<float>::infinity());
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    for (std::size_t part = 0; part < parts; ++part) {
      const std::size_t k = part * Lanes::width;
      const Vector value = dx * Lanes::load(rough[i].x + k) + dy * Lanes::load(rough[i].y + k) +
                           dz * Lanes::load(rough[i].z + k);
      values[i * parts + part] = value;
      best = Lanes::max(best, value);
    }
  }
  const Vector least = Lanes::broadcast(Lanes::reduce_max(best) - 0x1p-20f * length);
  constexpr unsigned all_lanes = (1u << Lanes::width) - 1;
  constexpr std::size_t blocks_a_word = 64 / size, most_words = most_blocks / blocks_a_word;
  std::uint64_t words[most_words];  // a bit for each vertex that may be the furthest
  std::size_t count = 0, last = 0;
  std::uint64_t others = 0;  // not zero if there are several
  for (std::size_t first = 0; first < blocks.size(); first += blocks_a_word) {
    std::uint64_t places = 0;
    for (std::size_t i = first; i < std::min(first + blocks_a_word, blocks.size()); ++i) {
      for (std::size_t part = 0; part < parts; ++part) {
        const std::size_t place = (i - first) * size + part * Lanes::width;
        const unsigned less = Lanes::to_bits(Lanes::less(values[i * parts + part], least));
        places |= std::uint64_t{~less & all_lanes} << place;
      }
    }
    if (places != 0) {
      others |= (places & (places - 1)) | (count > 0 ? words[last] : 0);
      last = count;
    }
    words[count++] = places;
  }
  const auto index_at = [](std::size_t word, std::uint64_t places) {
    return static_cast<std::uint32_t>(64 * word +
                                      static_cast<std::size_t>(std::countr_zero(places)));
  };
  if (others == 0) return index_at(last, words[last]);
  Found<double> furthest{-std::numeric_limits<double>::infinity(), 0};
  for (std::size_t word = 0; word <= last; ++word) {
    for (std::uint64_t places = words[word]; places != 0; places &= places - 1) {
      const std::uint32_t index = index_at(word, places);
      const VertexBlock<double>& block = blocks[index / size];
      const std::size_t k = index % size;
      const double value = x * block.x[k] + y * block.y[k] + z * block.z[k];
      if (value > furthest.value) furthest = {value, index};
    }
  }
  return furthest.index;
}
