// The loops of the simultaneous descent, once for each level of vector instructions.

// Writes centres and half extents of a node's boxes, seen through the view if there is one and grown
// by `slack`. Returns the bits of the boxes that are not empty.
TOUCHSTONE_TARGET TOUCHSTONE_FLATTEN inline unsigned see_node(const WideNode& node,
                                                              const BoxView* view, float slack,
                                                              NodeBoxes& seen) {
  using Lanes = Simd<float>;
  using Vector = typename Lanes::Vector;
  const Vector half = Lanes::broadcast(0.5F), grown = Lanes::broadcast(slack);
  unsigned bits = 0;
  for (std::size_t at = 0; at < WideNode::fan; at += Lanes::width) {
    Vector centre[3], extent[3];
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector low = Lanes::load(&node.planes[k][at]);
      const Vector high = Lanes::load(&node.planes[3 + k][at]);
      if (k == 0) bits |= Lanes::to_bits(Lanes::less_equal(low, high)) << at;
      centre[k] = low * half + high * half;
      extent[k] = high * half - low * half;
    }
    for (std::size_t row = 0; row < 3; ++row) {
      Vector c = centre[row], h = extent[row];
      if (view != nullptr) {
        const auto& turn = view->turn[row];
        const auto& spread = view->spread[row];
        c = Lanes::broadcast(turn[0]) * centre[0] + Lanes::broadcast(turn[1]) * centre[1] +
            Lanes::broadcast(turn[2]) * centre[2] + Lanes::broadcast(view->offset[row]);
        h = Lanes::broadcast(spread[0]) * extent[0] + Lanes::broadcast(spread[1]) * extent[1] +
            Lanes::broadcast(spread[2]) * extent[2];
      }
      Lanes::store(&seen.centre[row][at], c);
      Lanes::store(&seen.half[row][at], h + grown);
    }
  }
  return bits;
}

// Returns the bits of a's boxes that box j of b may meet. NaN, of boundless boxes, means that they
// may.
TOUCHSTONE_TARGET TOUCHSTONE_INLINE unsigned meeting_boxes(const NodeBoxes& a, const NodeBoxes& b,
                                                           std::size_t j) {
  using Lanes = Simd<float>;
  unsigned apart = 0;
  for (std::size_t at = 0; at < WideNode::fan; at += Lanes::width) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto gap = Lanes::abs(Lanes::load(&a.centre[k][at]) - Lanes::broadcast(b.centre[k][j]));
      const auto reach = Lanes::load(&a.half[k][at]) + Lanes::broadcast(b.half[k][j]);
      apart |= Lanes::to_bits(Lanes::less(reach, gap)) << at;
    }
  }
  return ~apart & 0xffu;
}

// Writes for each child of b the bits of a's children that it may meet, and returns the bits of those of b
// that may meet any.
TOUCHSTONE_TARGET TOUCHSTONE_FLATTEN inline unsigned meeting_children(
    const WideNode& a, unsigned lanes_a, const WideNode& b, unsigned lanes_b,
    std::span<const DescentFrame> frames, std::array<std::uint8_t, WideNode::fan>& meeting) {
  NodeBoxes seen_a, seen_b;
  meeting.fill(static_cast<std::uint8_t>(lanes_a));
  for (const DescentFrame& frame : frames) {
    const unsigned in_a = see_node(a, frame.moves_a ? &frame.a : nullptr, 0, seen_a);
    lanes_b &= see_node(b, frame.moves_b ? &frame.b : nullptr, frame.b.slack, seen_b);
    for (unsigned bits = lanes_b; bits != 0; bits &= bits - 1) {
      const auto j = static_cast<std::size_t>(std::countr_zero(bits));
      const unsigned left = meeting[j] & in_a & meeting_boxes(seen_a, seen_b, j);
      meeting[j] = static_cast<std::uint8_t>(left);
      if (left == 0) lanes_b &= ~(1u << j);
    }
    if (lanes_b == 0) return 0;
  }
  return lanes_b;
}
