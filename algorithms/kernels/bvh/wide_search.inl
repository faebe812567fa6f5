// The loop of the search, once for each level of vector instructions.

// Returns the bits of the node's boxes that may be within the radius of the box. NaN, of boundless
// boxes, means that they may be: the greater of NaN and 0 is 0.
TOUCHSTONE_TARGET TOUCHSTONE_FLATTEN inline unsigned near_boxes(const WideNode& node,
                                                                const SearchBox& box) {
  using Lanes = Simd<float>;
  using Vector = typename Lanes::Vector;
  const Vector half = Lanes::broadcast(0.5F), zero = Lanes::broadcast(0);
  const Vector certain = Lanes::broadcast(1 - 0x1p-20F);
  const Vector radius = Lanes::broadcast(box.radius), seen = Lanes::broadcast(box.seen_radius);
  unsigned near = 0;
  for (std::size_t at = 0; at < WideNode::fan; at += Lanes::width) {
    Vector centre[3], extent[3];
    Vector sum = zero;
    unsigned bits = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector low = Lanes::load(&node.planes[k][at]);
      const Vector high = Lanes::load(&node.planes[3 + k][at]);
      if (k == 0) bits = Lanes::to_bits(Lanes::less_equal(low, high));
      centre[k] = low * half + high * half;
      extent[k] = high * half - low * half;
      const Vector apart = Lanes::abs(centre[k] - Lanes::broadcast(box.seen.centre[k]));
      const Vector gap = Lanes::max(apart - (extent[k] + Lanes::broadcast(box.seen.half[k])), zero);
      sum = sum + gap * gap;
    }
    bits &= ~Lanes::to_bits(Lanes::less(seen * seen, sum * certain));
    if (bits == 0) continue;
    sum = zero;
    for (std::size_t row = 0; row < 3; ++row) {
      const auto& turn = box.view.turn[row];
      const auto& spread = box.view.spread[row];
      const Vector c = Lanes::broadcast(turn[0]) * centre[0] +
                       Lanes::broadcast(turn[1]) * centre[1] +
                       Lanes::broadcast(turn[2]) * centre[2] +
                       Lanes::broadcast(box.view.offset[row] - box.own.centre[row]);
      const Vector h = Lanes::broadcast(spread[0]) * extent[0] +
                       Lanes::broadcast(spread[1]) * extent[1] +
                       Lanes::broadcast(spread[2]) * extent[2];
      const Vector gap =
          Lanes::max(Lanes::abs(c) - (h + Lanes::broadcast(box.own.half[row])), zero);
      sum = sum + gap * gap;
    }
    bits &= ~Lanes::to_bits(Lanes::less(radius * radius, sum * certain));
    near |= bits << at;
  }
  return near;
}
