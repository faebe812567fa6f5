// The loop of gauss_arcs.h. gauss_arcs.cpp includes this file once for each level of vector
// instructions, inside that level's namespace.

// Returns the block's arcs that may cross, as bits.
TOUCHSTONE_TARGET inline unsigned crossing_of(const GaussBlock& block, const GaussArc& arc) {
  using Lanes = Simd<float>;
  using Vector = Lanes::Vector;
  unsigned open = 0;
  const Vector most = Lanes::broadcast(uncertain), least = Lanes::broadcast(-uncertain);
  for (std::size_t part = 0; part < GaussBlock::size; part += Lanes::width) {
    const auto product = [&](std::size_t row, const Vec3<float>& v) TOUCHSTONE_TARGET {
      const Vector x = Lanes::load(block.rows[row].data() + part);
      const Vector y = Lanes::load(block.rows[row + 1].data() + part);
      const Vector z = Lanes::load(block.rows[row + 2].data() + part);
      return x * Lanes::broadcast(v.x()) + y * Lanes::broadcast(v.y()) +
             z * Lanes::broadcast(v.z());
    };
    const Vector b_left = product(3, arc.direction), b_right = product(6, arc.direction);
    const Vector a_left = product(0, arc.left), a_right = product(0, arc.right);
    // The ends of one arc are on one side of the other's circle.
    const unsigned same_side = Lanes::to_bits(Lanes::less(most, Lanes::min(b_left, b_right))) |
                               Lanes::to_bits(Lanes::less(Lanes::max(b_left, b_right), least)) |
                               Lanes::to_bits(Lanes::less(most, Lanes::min(a_left, a_right))) |
                               Lanes::to_bits(Lanes::less(Lanes::max(a_left, a_right), least));
    // The circles meet in two points, and the arcs pass through opposite ones.
    const unsigned opposite =
        (Lanes::to_bits(Lanes::less(most, a_left)) & Lanes::to_bits(Lanes::less(b_left, least))) |
        (Lanes::to_bits(Lanes::less(a_left, least)) & Lanes::to_bits(Lanes::less(most, b_left)));
    open |= (~(same_side | opposite) & ((1u << Lanes::width) - 1)) << part;
  }
  return open;
}

TOUCHSTONE_TARGET void list_crossing(std::span<const GaussBlock> blocks, std::size_t arcs,
                                     const GaussArc& arc, std::vector<std::uint32_t>& crossing) {
  for (std::size_t first = 0; first < arcs; first += GaussBlock::size) {
    unsigned open = crossing_of(blocks[first / GaussBlock::size], arc);
    if (arcs - first < GaussBlock::size) open &= (1u << (arcs - first)) - 1;
    for (; open != 0; open &= open - 1) {
      const std::size_t k = first + static_cast<std::size_t>(std::countr_zero(open));
      crossing.push_back(static_cast<std::uint32_t>(k));
    }
  }
}
