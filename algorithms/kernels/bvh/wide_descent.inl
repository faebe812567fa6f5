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

// Returns the bits of b's boxes that box i of a may meet. NaN, of boundless boxes, means that they
// may.
TOUCHSTONE_TARGET TOUCHSTONE_FLATTEN inline unsigned meeting_boxes(const NodeBoxes& a,
                                                                   std::size_t i,
                                                                   const NodeBoxes& b) {
  using Lanes = Simd<float>;
  unsigned apart = 0;
  for (std::size_t at = 0; at < WideNode::fan; at += Lanes::width) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto gap = Lanes::abs(Lanes::load(&b.centre[k][at]) - Lanes::broadcast(a.centre[k][i]));
      const auto reach = Lanes::load(&b.half[k][at]) + Lanes::broadcast(a.half[k][i]);
      apart |= Lanes::to_bits(Lanes::less(reach, gap)) << at;
    }
  }
  return ~apart & 0xffu;
}
