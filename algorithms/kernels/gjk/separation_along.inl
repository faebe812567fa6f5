// The loops of separation_along.h: separation_at is separation_along at one level of vector
// instructions, and support_value_at is each body's part of it. separation_along.cpp includes this
// file once for each level, inside that level's namespace. Results are equal at every level.

// The greatest direction . x over the core, relative to its centre.
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Scalar support_value_at(PosedShape<Scalar>& turned, Scalar x,
                                                            Scalar y, Scalar z) {
  using Core = typename SupportShape<Scalar>::Core;
  const SupportShape<Scalar>& shape = turned.shape();
  if (shape.core == Core::point) return 0;
  const Mat3<Scalar>& m = turned.matrix();
  const Vec3<Scalar>& e = shape.extents;
  const Scalar dx = m(0, 0) * x + m(1, 0) * y + m(2, 0) * z;
  const Scalar dy = m(0, 1) * x + m(1, 1) * y + m(2, 1) * z;
  const Scalar dz = m(0, 2) * x + m(1, 2) * y + m(2, 2) * z;
  if (shape.core == Core::box) {
    return std::abs(dx) * e.x() + std::abs(dy) * e.y() + std::abs(dz) * e.z();
  }
  if (shape.core == Core::hull && shape.cells.empty()) {
    const std::span<const hull_scan::VertexBlock<Scalar>> blocks(shape.vertices);
    return furthest_at(blocks, dx, dy, dz).value;
  }
  const Vec3<Scalar> direction{x, y, z};
  return direction.dot(turned.support(direction));
}

// Returns what separation_along returns, and does not count the support call.
template <class Scalar>
TOUCHSTONE_TARGET Scalar separation_at(SupportPair<Scalar>& pair, const Vec3<Scalar>& n) {
  const Scalar of_b = support_value_at(pair.b(), -n.x(), -n.y(), -n.z());
  const Scalar of_a = support_value_at(pair.a(), n.x(), n.y(), n.z());
  return n.dot(pair.centre_b()) - of_b - of_a;
}
