// The triangles above points. ray_walk.cpp includes this file once for each level of vector instructions,
// inside that level's namespace.
//
// A ray straight up needs no times: a box is met that reaches over the point, which floats bound on each axis
// (near_origin is above it, far_origin below). The order of the boxes is no matter.

// The children of a node that reach above the point, as bits. Lanes without a child have empty boxes.
TOUCHSTONE_TARGET TOUCHSTONE_INLINE unsigned reaching_above(const WideNode& node,
                                                            const RayBlock& block,
                                                            std::size_t ray) {
  unsigned bits = 0;
  for (std::size_t part = 0; part < 8; part += width) {
    auto met = Lanes::less_equal(all(block.far_origin[2][ray]), Lanes::load(&node.planes[5][part]));
    for (std::size_t k = 0; k < 2; ++k) {
      met = Lanes::less_equal(met, Lanes::load(&node.planes[k][part]),
                              all(block.near_origin[k][ray]));
      met = Lanes::less_equal(met, all(block.far_origin[k][ray]),
                              Lanes::load(&node.planes[3 + k][part]));
    }
    bits |= Lanes::to_bits(met) << part;
  }
  return bits;
}

// The triangles of a leaf that may be above the point, as bits; those of them that are for certain; and
// those that turn up if they do.
struct LeafAbove {
  unsigned possible = 0, certain = 0, up = 0;
};

// Errors are those of `meet` for a ray without a shear.
TOUCHSTONE_TARGET TOUCHSTONE_INLINE LeafAbove above(const Leaf& leaf, const RayBlock& block,
                                                    std::size_t ray) {
  LeafAbove found;
  const Vector zero = all(0), off = all(block.off[ray]), z_off = all(block.tau_off[ray]);
  for (std::size_t part = 0; part < 8; part += width) {
    Vector x[3], y[3], z[3], side[3];
    for (std::size_t k = 0; k < 3; ++k) {
      x[k] = Lanes::load(&leaf.corners[3 * k][part]) - all(block.origin[0][ray]);
      y[k] = Lanes::load(&leaf.corners[3 * k + 1][part]) - all(block.origin[1][ray]);
      z[k] = Lanes::load(&leaf.corners[3 * k + 2][part]) - all(block.origin[2][ray]);
      side[k] = Lanes::abs(x[k]) + Lanes::abs(y[k]);
    }
    const Vector a = x[1] * y[2] - y[1] * x[2];
    const Vector b = x[2] * y[0] - y[2] * x[0];
    const Vector c = x[0] * y[1] - y[0] * x[1];
    const Vector reach = Lanes::max(Lanes::max(side[0], side[1]), side[2]);
    const Vector error = all(2.02F) * off * (reach + off) +
                         all(4 * static_cast<float>(float_unit)) * reach * reach + all(0x1p-120F);
    const Vector least = Lanes::min(Lanes::min(a, b), c);
    const Vector most = Lanes::max(Lanes::max(a, b), c);
    const Vector lowest = Lanes::min(Lanes::min(z[0], z[1]), z[2]);
    const Vector highest = Lanes::max(Lanes::max(z[0], z[1]), z[2]);
    const unsigned missed =
        Lanes::to_bits(Lanes::less(least + error, zero)) & Lanes::to_bits(Lanes::less(error, most));
    const unsigned possible = Lanes::to_bits(Lanes::less_equal(zero - z_off, highest)) & ~missed;
    const unsigned up = Lanes::to_bits(Lanes::less(error, least));
    const unsigned down = Lanes::to_bits(Lanes::less(most, zero - error));
    const unsigned certain = possible & (up | down) & Lanes::to_bits(Lanes::less(z_off, lowest));
    found.possible |= possible << part;
    found.certain |= certain << part;
    found.up |= up << part;
  }
  return found;
}

// Counts the triangles of a leaf. Returns true if the point is on one.
TOUCHSTONE_TARGET TOUCHSTONE_INLINE bool wind_leaf(const RayMesh& mesh, const Leaf& leaf,
                                                   const RayBlock& block, std::size_t ray,
                                                   WindingQuery& query) {
  const LeafAbove found = above(leaf, block, ray);
  query.count(std::popcount(found.certain & found.up) - std::popcount(found.certain & ~found.up));
  for (unsigned bits = found.possible & ~found.certain; bits != 0; bits &= bits - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(bits));
    const auto [a, b, c] = mesh.corners(leaf, lane);
    if (query.offer(leaf.triangle[lane], a, b, c)) return true;
  }
  return false;
}

TOUCHSTONE_TARGET void wind_point(const RayMesh& mesh, const RayBlock& block, std::size_t ray,
                                  WindingQuery& query) {
  const WideNode* const nodes = mesh.tree().nodes.data();
  std::array<std::int32_t, WideBvh::most_open + WideNode::fan> stack;
  std::size_t open = 1;
  stack[0] = 0;
  while (open > 0) {
    const WideNode& node = nodes[stack[--open]];
    for (unsigned bits = reaching_above(node, block, ray); bits != 0; bits &= bits - 1) {
      const std::int32_t child = node.child[static_cast<std::size_t>(std::countr_zero(bits))];
      if (!WideNode::is_leaf(child)) {
        stack[open++] = child;
      } else if (wind_leaf(mesh, mesh.leaves()[WideNode::leaf(child)], block, ray, query)) {
        return;
      }
    }
  }
}

TOUCHSTONE_TARGET void wind_block(const RayMesh& mesh, std::span<WindingQuery> queries,
                                  RayBlock& block) {
  localise(mesh, block);
  for (std::size_t i = 0; i < queries.size(); ++i) {
    // A point that is too far for that is outside.
    if (block.is_usable(i)) wind_point(mesh, block, i, queries[i]);
  }
}
