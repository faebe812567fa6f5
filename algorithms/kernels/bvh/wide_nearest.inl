// The loops of the search for the nearest leaves, once for each level of vector instructions.

// Raises the bounds on the distances of box i of a and the boxes of b to those of their gaps along the
// axes of the frame, in which lengths are at most 1 / factor of the true ones.
TOUCHSTONE_TARGET TOUCHSTONE_FLATTEN inline void raise_by_boxes(const NodeBoxes& a, std::size_t i,
                                                                const NodeBoxes& b, float factor,
                                                                std::array<float, fan>& bound) {
  using Lanes = Simd<float>;
  using Vector = typename Lanes::Vector;
  const Vector zero = Lanes::broadcast(0), shorter = Lanes::broadcast(factor);
  const Vector most = Lanes::broadcast(std::numeric_limits<float>::max());
  for (std::size_t at = 0; at < fan; at += Lanes::width) {
    Vector sum = zero, widest = zero;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector gap =
          Lanes::abs(Lanes::load(&b.centre[k][at]) - Lanes::broadcast(a.centre[k][i])) -
          (Lanes::load(&b.half[k][at]) + Lanes::broadcast(a.half[k][i]));
      const Vector apart = Lanes::select(Lanes::less(zero, gap), gap, zero);
      sum = sum + apart * apart;
      widest = Lanes::max(widest, apart);
    }
    // Squares end where floats do, and lose their precision before.
    const Vector root = Lanes::select(Lanes::less_equal(sum, most), Lanes::sqrt(sum), widest);
    const Vector sure =
        Lanes::select(Lanes::less(Lanes::broadcast(1e-30F), sum), root, widest) * shorter;
    const Vector known = Lanes::load(&bound[at]);
    const Vector higher = Lanes::select(Lanes::less(known, sure), sure, known);
    Lanes::store(&bound[at], Lanes::select(Lanes::less_equal(higher, most), higher, known));
  }
}

// Returns the bits of the bounds that are below `upper`.
TOUCHSTONE_TARGET TOUCHSTONE_FLATTEN inline unsigned bounds_below(
    float upper, const std::array<float, fan>& bound) {
  using Lanes = Simd<float>;
  unsigned near = 0;
  for (std::size_t at = 0; at < fan; at += Lanes::width) {
    near |= Lanes::to_bits(Lanes::less(Lanes::load(&bound[at]), Lanes::broadcast(upper))) << at;
  }
  return near;
}
