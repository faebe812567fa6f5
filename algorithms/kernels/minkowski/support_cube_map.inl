// The loops of support_cube_map.h. support_cube_map.cpp includes this file once for each level of
// vector instructions, inside that level's namespace.

// Returns the best of `count` blocks: first the greatest value, then its place.
template <class Scalar, std::size_t count>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE typename SupportCubeMap<Scalar>::Found best_of(
    const typename SupportCubeMap<Scalar>::Block* blocks, const std::uint16_t* chosen, Scalar x,
    Scalar y, Scalar z) {
  using Lanes = Simd<Scalar>;
  using Vector = typename Lanes::Vector;
  constexpr std::size_t block_size = SupportCubeMap<Scalar>::block_size;
  constexpr std::size_t parts = block_size / Lanes::width;
  const Vector dx = Lanes::broadcast(x), dy = Lanes::broadcast(y), dz = Lanes::broadcast(z);
  Vector values[count * parts];
  Vector best = Lanes::broadcast(-std::numeric_limits<Scalar>::infinity());
  for (std::size_t i = 0; i < count; ++i) {
    const auto& block = blocks[chosen[i]];
    for (std::size_t part = 0; part < parts; ++part) {
      const std::size_t k = part * Lanes::width;
      const Vector value = dx * Lanes::load(block.x + k) + dy * Lanes::load(block.y + k) +
                           dz * Lanes::load(block.z + k);
      values[i * parts + part] = value;
      best = Lanes::max(best, value);
    }
  }
  const Scalar greatest = Lanes::reduce_max(best);
  const Vector all = Lanes::broadcast(greatest);
  constexpr unsigned all_lanes = (1u << Lanes::width) - 1;
  std::uint64_t places = 0;
  for (std::size_t i = 0; i < count * parts; ++i) {
    const unsigned less = Lanes::to_bits(Lanes::less(values[i], all));
    places |= std::uint64_t{~less & all_lanes} << i * Lanes::width;
  }
  const auto at = static_cast<std::size_t>(std::countr_zero(places)) % (count * block_size);
  return {greatest,
          static_cast<std::uint32_t>(chosen[at / block_size] * block_size + at % block_size)};
}

template <class Scalar>
TOUCHSTONE_TARGET typename SupportCubeMap<Scalar>::Found furthest_at(
    const SupportCubeMap<Scalar>& cells, Scalar x, Scalar y, Scalar z) {
  const auto& cell = cells.cell_of(x, y, z);
  if (!cell.is_listed()) [[likely]] {
    return best_of<Scalar, 4>(cells.blocks(), cell.blocks.data(), x, y, z);
  }
  const std::uint16_t* list = cells.list(cell);
  typename SupportCubeMap<Scalar>::Found best{-std::numeric_limits<Scalar>::infinity(), 0};
  for (std::size_t count = *list++; count > 0; --count) {
    const auto found = best_of<Scalar, 1>(cells.blocks(), list++, x, y, z);
    if (found.value > best.value) best = found;
  }
  return best;
}

// Writes the height of each vertex in each of four directions to `along`. Returns the heights of
// the vertices that are furthest in these and in their mean direction.
TOUCHSTONE_TARGET inline Bars measure_at(const Vertices& vertices,
                                         const std::array<Vec3d, 4>& corners,
                                         std::array<std::vector<double>, 4>& along) {
  using Lanes = Simd<double>;
  using Vector = typename Lanes::Vector;
  const std::size_t count = vertices.rounded_size();
  Vector best[5], at[5];
  for (std::size_t i = 0; i < 5; ++i) {
    best[i] = Lanes::broadcast(-std::numeric_limits<double>::infinity());
    at[i] = Lanes::broadcast(0);
  }
  double first[Lanes::width];
  for (std::size_t i = 0; i < Lanes::width; ++i) first[i] = static_cast<double>(i);
  Vector number = Lanes::load(first);
  Vector directions[4][3];
  for (std::size_t i = 0; i < 4; ++i) {
    for (int k = 0; k < 3; ++k) directions[i][k] = Lanes::broadcast(corners[i][k]);
  }
  for (std::size_t k = 0; k < count; k += Lanes::width) {
    const Vector x = Lanes::load(&vertices.x[k]), y = Lanes::load(&vertices.y[k]);
    const Vector z = Lanes::load(&vertices.z[k]);
    Vector value[5];
    for (std::size_t i = 0; i < 4; ++i) {
      value[i] = directions[i][0] * x + directions[i][1] * y + directions[i][2] * z;
      std::memcpy(&along[i][k], &value[i], sizeof value[i]);
    }
    value[4] = (value[0] + value[1]) + (value[2] + value[3]);
    for (std::size_t i = 0; i < 5; ++i) {
      const auto better = Lanes::less(best[i], value[i]);
      best[i] = Lanes::select(better, value[i], best[i]);
      at[i] = Lanes::select(better, number, at[i]);
    }
    number = number + Lanes::broadcast(static_cast<double>(Lanes::width));
  }
  Bars bars;
  for (std::size_t i = 0; i < 5; ++i) {
    std::size_t lane = 0;
    for (std::size_t l = 1; l < Lanes::width; ++l) {
      if (best[i][l] > best[i][lane]) lane = l;
    }
    const auto furthest = static_cast<std::size_t>(at[i][lane]);
    for (std::size_t k = 0; k < 4; ++k) bars[i][k] = along[k][furthest];
  }
  return bars;
}

// Keeps the vertices that reach one of the four heights of every bar.
TOUCHSTONE_TARGET inline void sift_at(const Vertices& from, const Bars& bars,
                                      const std::array<std::vector<double>, 4>& along,
                                      Vertices& to) {
  using Lanes = Simd<double>;
  using Vector = typename Lanes::Vector;
  Vector bar[5][4];
  for (std::size_t i = 0; i < 5; ++i) {
    for (std::size_t k = 0; k < 4; ++k) bar[i][k] = Lanes::broadcast(bars[i][k]);
  }
  to.clear();
  constexpr unsigned all_lanes = (1u << Lanes::width) - 1;
  for (std::size_t k = 0; k < from.size; k += Lanes::width) {
    const Vector a = Lanes::load(&along[0][k]), b = Lanes::load(&along[1][k]);
    const Vector c = Lanes::load(&along[2][k]), d = Lanes::load(&along[3][k]);
    Vector least = Lanes::broadcast(0);
    for (std::size_t i = 0; i < 5; ++i) {
      const Vector most = Lanes::max(Lanes::max(a - bar[i][0], b - bar[i][1]),
                                     Lanes::max(c - bar[i][2], d - bar[i][3]));
      least = Lanes::min(least, most);
    }
    unsigned kept = ~Lanes::to_bits(Lanes::less(least, Lanes::broadcast(0))) & all_lanes;
    for (; kept != 0; kept &= kept - 1) {
      const std::size_t i = k + static_cast<std::size_t>(std::countr_zero(kept));
      if (i < from.size) to.add(from, i);
    }
  }
  to.fill_up();
}
