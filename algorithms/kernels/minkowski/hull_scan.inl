// The loops of hull_scan.h, which includes this file once for each level of vector instructions,
// inside that level's namespace.

// Returns the best of at most `most_blocks` blocks: first the greatest value, then its place, so
// that no lane carries an index along.
template <class Scalar>
TOUCHSTONE_TARGET inline Found<Scalar> best_of(const VertexBlock<Scalar>* blocks, std::size_t count,
                                               Scalar x, Scalar y, Scalar z) {
  using Lanes = Simd<Scalar>;
  using Vector = typename Lanes::Vector;
  constexpr std::size_t parts = VertexBlock<Scalar>::size / Lanes::width;
  Vector values[most_blocks * parts];
  const Vector dx = Lanes::broadcast(x);
  const Vector dy = Lanes::broadcast(y);
  const Vector dz = Lanes::broadcast(z);
  Vector best = Lanes::broadcast(-std::numeric_limits<Scalar>::infinity());
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t part = 0; part < parts; ++part) {
      const std::size_t k = part * Lanes::width;
      const Vector value = dx * Lanes::load(blocks[i].x + k) + dy * Lanes::load(blocks[i].y + k) +
                           dz * Lanes::load(blocks[i].z + k);
      values[i * parts + part] = value;
      best = Lanes::max(best, value);
    }
  }
  const Scalar greatest = Lanes::reduce_max(best);
  const Vector all = Lanes::broadcast(greatest);
  constexpr unsigned all_lanes = (1u << Lanes::width) - 1;
  constexpr std::size_t blocks_a_word = 64 / VertexBlock<Scalar>::size;
  for (std::size_t word = 0; word < count; word += blocks_a_word) {
    std::uint64_t places = 0;
    for (std::size_t i = word; i < std::min(word + blocks_a_word, count); ++i) {
      for (std::size_t part = 0; part < parts; ++part) {
        const std::size_t place = (i - word) * VertexBlock<Scalar>::size + part * Lanes::width;
        const unsigned less = Lanes::to_bits(Lanes::less(values[i * parts + part], all));
        places |= std::uint64_t{~less & all_lanes} << place;
      }
    }
    if (places != 0) {
      const std::size_t first = word * VertexBlock<Scalar>::size;
      return {greatest, static_cast<std::uint32_t>(first) +
                            static_cast<std::uint32_t>(std::countr_zero(places))};
    }
  }
  return {greatest, 0};
}

// The same for as many blocks as are known when this is compiled, so that all values stay in registers.
template <class Scalar, std::size_t count>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Found<Scalar> best_of_few(const VertexBlock<Scalar>* blocks,
                                                              Scalar x, Scalar y, Scalar z) {
  using Lanes = Simd<Scalar>;
  using Vector = typename Lanes::Vector;
  constexpr std::size_t size = VertexBlock<Scalar>::size, parts = size / Lanes::width;
  static_assert(count * size <= 64);
  Vector values[count * parts];
  const Vector dx = Lanes::broadcast(x), dy = Lanes::broadcast(y), dz = Lanes::broadcast(z);
  Vector best = Lanes::broadcast(-std::numeric_limits<Scalar>::infinity());
#pragma GCC unroll 16
  for (std::size_t k = 0; k < count * parts; ++k) {
    const VertexBlock<Scalar>& block = blocks[k / parts];
    const std::size_t first = k % parts * Lanes::width;
    values[k] = dx * Lanes::load(block.x + first) + dy * Lanes::load(block.y + first) +
                dz * Lanes::load(block.z + first);
    best = Lanes::max(best, values[k]);
  }
  const Scalar greatest = Lanes::reduce_max(best);
  const Vector all = Lanes::broadcast(greatest);
  std::uint64_t less = 0;
#pragma GCC unroll 16
  for (std::size_t k = 0; k < count * parts; ++k) {
    less |= std::uint64_t{Lanes::to_bits(Lanes::less(values[k], all))} << (k * Lanes::width);
  }
  const std::uint64_t places = ~less & (~std::uint64_t{0} >> (64 - count * size));
  return {greatest, places != 0 ? static_cast<std::uint32_t>(std::countr_zero(places)) : 0};
}

template <class Scalar>
TOUCHSTONE_TARGET inline Found<Scalar> furthest_at(std::span<const VertexBlock<Scalar>> blocks,
                                                   Scalar x, Scalar y, Scalar z) {
  if (blocks.size() == 1) return best_of_few<Scalar, 1>(blocks.data(), x, y, z);
  if (blocks.size() == 2) return best_of_few<Scalar, 2>(blocks.data(), x, y, z);
  if (blocks.size() <= most_blocks) return best_of<Scalar>(blocks.data(), blocks.size(), x, y, z);
  Found<Scalar> best{-std::numeric_limits<Scalar>::infinity(), 0};
  for (std::size_t i = 0; i < blocks.size(); i += most_blocks) {
    const std::size_t count = std::min(most_blocks, blocks.size() - i);
    const Found<Scalar> found = best_of<Scalar>(&blocks[i], count, x, y, z);
    if (found.value > best.value) {
      const auto before = static_cast<std::uint32_t>(i * VertexBlock<Scalar>::size);
      best = {found.value, before + found.index};
    }
  }
  return best;
}

#include "algorithms/kernels/minkowski/rough_scan.inl"

// The index of the same, of a hull that may have its vertices as floats too.
template <class Scalar>
TOUCHSTONE_TARGET inline std::uint32_t furthest_index(const ScannedHull<Scalar>& hull, Scalar x,
                                                      Scalar y, Scalar z) {
  if constexpr (std::is_same_v<Scalar, double>) {
    if (hull.rough != nullptr) return furthest_by_floats(hull.rough, hull.blocks, x, y, z);
  }
  return furthest_at(hull.blocks, x, y, z).index;
}
